"""Stiffness laws of the two kinds of mesh of a scene: given, or computed from the teeth."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ..mesh.stiffness import DIGITS, StiffnessLaw, given_stiffness, tooth_stiffness
from ..mesh.tip_relief import PairGap, Relief
from ..mesh.tooth_pairs import Along
from ..scene import Scene
from ..scene.faults import Crack
from ..scene.mesh import TipReliefs
from ..tooth.contact import ContactLaw, weber_banaschek, yang_sun
from ..tooth.crack import Crack as RootCrack
from ..tooth.material import Material
from ..tooth.pair import ToothPair
from ..tooth.tooth import Tooth
from .static_load import mesh_force

GEARS = (("sun", "planet"), ("planet", "ring"))  # of each kind of mesh: first and second
LIGHTEST_LINE_LOAD = 1e3  # [N/m] contact compliance at lower loads is that of this load


def stiffness_laws(scene: Scene) -> tuple[StiffnessLaw, StiffnessLaw]:
    """Laws of sun-planet and planet-ring meshes.

    Raises:
        ValueError: such teeth cannot exist (see `tooth.pair`).
    """
    mesh = scene.mesh
    if mesh.stiffness == "involute":
        first, second = (_tooth_law(scene, pair) for pair in tooth_pairs(scene))
        return first, second
    along = math.cos(scene.gearset.pressure_angle) if mesh.motion == "pitch_arc" else 1.0
    ratio = mesh.double_pair_ratio
    assert mesh.sun_planet_stiffness is not None and mesh.planet_ring_stiffness is not None
    return (
        given_stiffness(mesh.sun_planet_stiffness / along, ratio),
        given_stiffness(mesh.planet_ring_stiffness / along, ratio),
    )


def stiffness_follows_load(scene: Scene) -> bool:
    """Whether the stiffness of the teeth depends on the torque of the scene."""
    if scene.mesh.tip_relief != TipReliefs():
        return True
    return scene.mesh.stiffness == "involute" and scene.mesh.tooth.contact != "yang_sun"


def pair_gap(scene: Scene, kind: int) -> PairGap | None:
    """Gap of the pairs of a kind of mesh by tip relief, None without relief."""
    mesh, reliefs = scene.gearset.geometry.meshes[kind], scene.mesh.tip_relief
    given = [getattr(reliefs, gear) for gear in GEARS[kind]]
    if not any(relief is not None and relief.amount > 0.0 for relief in given):
        return None
    first, second = (
        None if one is None else Relief(one.amount, one.length / mesh.base_pitch, one.shape)
        for one in given
    )
    return PairGap(mesh.path, first, second)


def loaded_force(scene: Scene) -> float:
    """Force of a mesh [N] at the torque of the scene, at least a light load."""
    force = abs(mesh_force(scene, scene.operating_point.input_torque))
    return max(force, LIGHTEST_LINE_LOAD * scene.gearset.face_width)


def tooth_pairs(scene: Scene) -> tuple[ToothPair, ToothPair]:
    """Healthy pairs of sun and planet, and of planet and ring."""
    gears, oil, how = scene.gearset.geometry, scene.lubrication, scene.mesh.tooth
    material, contact = Material(oil.youngs_modulus, oil.poisson_ratio), _contact(scene)
    sun, planet, ring = (
        Tooth(gear, material, how.rim if gear.internal else how.hub)
        for gear in (gears.sun, gears.planet, gears.ring)
    )
    sun_planet, planet_ring = gears.meshes
    return (
        ToothPair(sun, planet, sun_planet.path, contact, angle=sun_planet.pressure_angle),
        ToothPair(planet, ring, planet_ring.path, contact, angle=planet_ring.pressure_angle),
    )


def crack_factor(scene: Scene, crack: Crack, kind: int) -> Along:
    """Stiffness of a pair with a cracked tooth over that of a healthy one, by position."""
    left = 1.0 - (crack.stiffness_loss or 0.0)
    if crack.depth is None:
        return lambda s: np.full_like(s, left)
    healthy = tooth_pairs(scene)[kind]
    side = "first" if GEARS[kind][0] == crack.gear else "second"
    root_crack = RootCrack(crack.depth, crack.angle)
    cracked = replace(healthy, **{side: replace(getattr(healthy, side), crack=root_crack)})
    return lambda s: np.round(healthy.compliance(s) / cracked.compliance(s), DIGITS)


def _tooth_law(scene: Scene, pair: ToothPair) -> StiffnessLaw:
    width = scene.gearset.face_width
    return tooth_stiffness(lambda s: pair.stiffness(s, width), pair.path, pair.shared_body_factor)


def _contact(scene: Scene) -> ContactLaw:
    if scene.mesh.tooth.contact == "yang_sun":
        return yang_sun
    force = abs(mesh_force(scene, scene.operating_point.input_torque))
    return weber_banaschek(max(force / scene.gearset.face_width, LIGHTEST_LINE_LOAD))
