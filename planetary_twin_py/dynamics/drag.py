"""Drag outside the tooth contacts: bearings, seals and grease, and members that churn oil."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from .._compile import kernel, law
from .._records import BODIES, REAL, WHOLE, Record
from ..losses.bearing import bearing_torque
from ..losses.churning import disc_torque
from ..scene import Scene
from ..scene.losses import Bearing
from .alike import planet_groups
from .bodies import Bodies
from .body_speed import body_speed
from .state import BEARING, CHURNING

MEMBERS = ("sun", "ring", "carrier")
SLOWEST_TURN = 1e-2  # [rad/s] below which the sense of drag fades out
NO_PLANET = -1
JOINTS = BODIES + len(MEMBERS)  # room: a bearing of every body, a drag of every member

DRAG_LAYOUT = {
    "joints": WHOLE,  # bearings, and members with a drag of their own
    "joint_body": (WHOLE, (JOINTS, 2)),  # what turns, and against what
    "joint_planet": (WHOLE, (JOINTS,)),  # whose pin loads it, or NO_PLANET
    "joint_idle": (REAL, (JOINTS,)),  # f0 dm^3 [m^3]
    "joint_rubbing": (REAL, (JOINTS,)),  # f1 dm [m]
    "joint_coulomb": (REAL, (JOINTS,)),  # [N m]
    "joint_viscous": (REAL, (JOINTS,)),  # [N m s/rad]
    "pin_share": REAL,  # load on a pin per sum of the forces of its planet's meshes [-]
    "discs": WHOLE,
    "disc_body": (WHOLE, (len(MEMBERS),)),
    "disc_radius": (REAL, (len(MEMBERS),)),  # [m]
    "disc_gap": REAL,  # [m]
    "disc_fill": REAL,  # share of oil in what they turn in [-]
}


class _Joint(NamedTuple):
    """What resists the rotation of one body against another; see `DRAG_LAYOUT`."""

    body: tuple[int, int]
    planet: int = NO_PLANET
    idle: float = 0.0
    rubbing: float = 0.0
    coulomb: float = 0.0
    viscous: float = 0.0


def build_drag(scene: Scene, bodies: Bodies) -> dict[str, object]:
    """Fields of `DRAG_LAYOUT`."""
    joints, place, churning = list(_joints(scene, bodies)), bodies.place, scene.losses.churning
    discs = {m: getattr(churning, m) for m in MEMBERS if churning and getattr(churning, m)}
    return {
        "joints": len(joints),
        "joint_body": np.array([joint.body for joint in joints], dtype=int).reshape(-1, 2),
        "joint_planet": np.array([joint.planet for joint in joints], dtype=int),
        "joint_idle": np.array([joint.idle for joint in joints]),
        "joint_rubbing": np.array([joint.rubbing for joint in joints]),
        "joint_coulomb": np.array([joint.coulomb for joint in joints]),
        "joint_viscous": np.array([joint.viscous for joint in joints]),
        "pin_share": _pin_share(scene),
        "discs": len(discs),
        "disc_body": np.array([place[member] for member in discs], dtype=int),
        "disc_radius": np.array(list(discs.values()), dtype=float),
        "disc_gap": churning.gap if churning else 0.0,
        "disc_fill": churning.fill if churning else 0.0,
    }


def _pin_share(scene: Scene) -> float:
    """cos((a_s + a_r)/2) with the working pressure angles of both meshes of a planet.

    Equal forces F along their lines of action add up to 2 F cos((a_s + a_r)/2).
    """
    sun, ring = (mesh.pressure_angle for mesh in scene.gearset.geometry.meshes)
    return math.cos(0.5 * (sun + ring))


def _joints(scene: Scene, bodies: Bodies) -> Iterator[_Joint]:
    losses, place, ground = scene.losses, bodies.place, len(bodies.mass) - 1
    if losses.planet_bearing is not None:
        for i, leader in enumerate(planet_groups(scene).leaders):
            pair = (place[f"planet_{leader + 1}"], place["carrier"])
            yield _Joint(pair, i, *_palmgren(losses.planet_bearing))
    for member in MEMBERS:
        bearing, drag = getattr(losses, f"{member}_bearing"), getattr(losses, f"{member}_drag")
        if bearing is not None:
            yield _Joint((place[member], ground), NO_PLANET, *_palmgren(bearing))
        if drag.coulomb > 0.0 or drag.viscous > 0.0:
            yield _Joint((place[member], ground), coulomb=drag.coulomb, viscous=drag.viscous)


def _palmgren(bearing: Bearing) -> tuple[float, float]:
    return bearing.f0 * bearing.mean_diameter**3, bearing.f1 * bearing.mean_diameter


@law
def _sense(speed: float) -> float:
    return speed / math.sqrt(speed * speed + SLOWEST_TURN * SLOWEST_TURN)


@law
def _pin_load(train: Record, state: Record, out: Record, planet: int) -> float:
    """Load [N] on the pin of a planet, whose two meshes add up or oppose each other."""
    if planet == NO_PLANET:
        return 0.0
    ring = train.meshes // 2 + planet
    return train.pin_share * abs(
        state.side[planet] * out.now.push[planet] + state.side[ring] * out.now.push[ring]
    )


@kernel
def apply_drag(model: Record, state: Record, v: np.ndarray, out: Record) -> None:
    """Add the drag of joints and discs to out.rubbing; book it in out.power.

    Reads the pushes of the meshes from `out.now`.
    """
    train, oil = model.train, model.oil
    for b in range(train.joints):
        inner, outer = train.joint_body[b, 0], train.joint_body[b, 1]
        speed = body_speed(train, state, v, inner) - body_speed(train, state, v, outer)
        load = _pin_load(train, state, out, train.joint_planet[b])
        torque = train.joint_coulomb[b] + train.joint_viscous[b] * abs(speed)
        torque += bearing_torque(
            train.joint_idle[b], train.joint_rubbing[b], oil.kinematic, speed, load
        )
        torque *= _sense(speed) * train.body_copies[inner]
        out.rubbing[inner] -= torque / train.radius[inner]
        out.rubbing[outer] += torque / train.radius[outer]
        out.power[BEARING] += torque * speed
    for n in range(train.discs):
        body, radius = train.disc_body[n], train.disc_radius[n]
        speed = body_speed(train, state, v, body)
        density = train.disc_fill * oil.density
        torque = disc_torque(radius, train.disc_gap / radius, density, oil.kinematic, speed)
        torque *= _sense(speed)
        out.rubbing[body] -= torque / train.radius[body]
        out.power[CHURNING] += torque * speed
