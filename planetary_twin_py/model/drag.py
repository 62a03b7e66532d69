"""Drag outside the tooth contacts: bearings, seals, grease, and churning of oil."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from .._core import NO_PLANET
from ..scene.losses import Bearing
from .bodies import Bodies
from .layout import Layout
from .planar_rows import CENTRAL


class _Joint(NamedTuple):
    """Resistance to the rotation of one body relative to another; see `Train`."""

    body: tuple[int, int]  # indices of the rotating body, and of the one that it rotates against
    planet: int = NO_PLANET  # whose pin loads it
    no_load_factor: float = 0.0  # f0 dm^3 [m^3]
    load_factor: float = 0.0  # f1 dm [m]
    coulomb: float = 0.0  # [N m]
    viscous: float = 0.0  # [N m s/rad]


def build_drag(layout: Layout, bodies: Bodies) -> dict[str, Any]:
    """Fields of `Train`."""
    joints, place = list(_joints(layout, bodies)), bodies.place
    churning = layout.scene.losses.churning
    discs = {m: getattr(churning, m) for m in CENTRAL if churning and getattr(churning, m)}
    return {
        "joints": len(joints),
        "joint_body": np.array([joint.body for joint in joints], dtype=int).reshape(-1, 2),
        "joint_planet": np.array([joint.planet for joint in joints], dtype=int),
        "joint_no_load_factor": np.array([joint.no_load_factor for joint in joints]),
        "joint_load_factor": np.array([joint.load_factor for joint in joints]),
        "joint_coulomb": np.array([joint.coulomb for joint in joints]),
        "joint_viscous": np.array([joint.viscous for joint in joints]),
        "pin_share": _pin_share(layout),
        "discs": len(discs),
        "disc_body": np.array([place[member] for member in discs], dtype=int),
        "disc_radius": np.array(list(discs.values()), dtype=float),
        "disc_gap": churning.gap if churning else 0.0,
        "disc_fill": churning.fill if churning else 0.0,
    }


def _pin_share(layout: Layout) -> float:
    """cos((a_s + a_r)/2) with the working pressure angles of both meshes of a planet.

    Equal forces F along their lines of action add up to 2 F cos((a_s + a_r)/2).
    """
    sun, ring = (mesh.pressure_angle for mesh in layout.scene.gearset.geometry.meshes)
    return math.cos(0.5 * (sun + ring))


def _joints(layout: Layout, bodies: Bodies) -> Iterator[_Joint]:
    losses, place, ground = layout.scene.losses, bodies.place, bodies.ground
    if losses.planet_bearing is not None:
        for i, leader in enumerate(layout.leaders):
            pair = (place[leader], place["carrier"])
            yield _Joint(pair, i, *_palmgren(losses.planet_bearing))
    for member in CENTRAL:
        bearing, drag = getattr(losses, f"{member}_bearing"), getattr(losses, f"{member}_drag")
        if bearing is not None:
            yield _Joint((place[member], ground), NO_PLANET, *_palmgren(bearing))
        if drag.coulomb > 0.0 or drag.viscous > 0.0:
            yield _Joint((place[member], ground), coulomb=drag.coulomb, viscous=drag.viscous)


def _palmgren(bearing: Bearing) -> tuple[float, float]:
    return bearing.f0 * bearing.mean_diameter**3, bearing.f1 * bearing.mean_diameter
