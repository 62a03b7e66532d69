"""Stiffness laws of the two kinds of mesh of a scene: given, or computed from the teeth."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ..gearset.involute import SpurGear
from ..gearset.normal_plane import normal_angle, virtual_gear
from ..mesh.stiffness import DIGITS, StiffnessLaw, given_stiffness, tooth_stiffness
from ..mesh.tip_relief import PairGap, Relief
from ..mesh.tooth_pairs import Along
from ..mesh.worn import Worn
from ..scene import Scene
from ..scene.faults import Crack
from ..scene.mesh import TipReliefs
from ..scene.worn import WornFlanks
from ..tooth.contact import ContactLaw, weber_banaschek, yang_sun
from ..tooth.crack import Crack as RootCrack
from ..tooth.material import Material
from ..tooth.pair import ToothPair
from ..tooth.tooth import Tooth
from .layout import Layout

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
    along = math.cos(scene.gearset.transverse.pressure_angle) if mesh.motion == "pitch_arc" else 1.0
    ratio = mesh.double_pair_ratio
    assert mesh.sun_planet_stiffness is not None and mesh.planet_ring_stiffness is not None
    return (
        given_stiffness(mesh.sun_planet_stiffness / along, ratio),
        given_stiffness(mesh.planet_ring_stiffness / along, ratio),
    )


def stiffness_follows_load(scene: Scene) -> bool:
    """Whether the stiffness of the teeth depends on the torque of the scene."""
    mesh = scene.mesh
    if mesh.tip_relief != TipReliefs() or mesh.worn != WornFlanks() or mesh.entry == "loaded":
        return True
    return scene.mesh.stiffness == "involute" and scene.mesh.tooth.contact != "yang_sun"


def pair_gap(scene: Scene, kind: int) -> PairGap | None:
    """Gap of the pairs of a kind of mesh by tip relief and wear, None without both."""
    mesh, reliefs = scene.gearset.geometry.meshes[kind], scene.mesh.tip_relief
    given, worn = [getattr(reliefs, gear) for gear in GEARS[kind]], _worn(scene, kind)
    if worn is None and not any(relief is not None and relief.amount > 0.0 for relief in given):
        return None
    first, second = (
        None if one is None else Relief(one.amount, one.length / mesh.base_pitch, one.shape)
        for one in given
    )
    return PairGap(mesh.path, first, second, worn)


def _worn(scene: Scene, kind: int) -> Worn | None:
    """Wear of both flanks of a kind of mesh, None if they are not worn."""
    given = scene.mesh.worn.meshes[kind]
    if given is None or not any(given.first + given.second):
        return None
    return Worn(np.array(given.position), np.array(given.first) + np.array(given.second))


def loaded_force(scene: Scene) -> float:
    """Force of a mesh [N] at the torque of the scene, at least a light load."""
    force = abs(Layout(scene).mesh_force(scene.operating_point.input_torque))
    return max(force, LIGHTEST_LINE_LOAD * scene.gearset.face_width)


def tooth_pairs(scene: Scene) -> tuple[ToothPair, ToothPair]:
    """Healthy pairs of sun and planet, and of planet and ring.

    Those of helical teeth are the pairs of their virtual spur gears in the normal plane, in which
    radii of curvature are rho_t/cos(beta_b).
    """
    gears, contact, helix = scene.gearset.geometry, _contact(scene), scene.gearset.helix_angle
    sun, planet, ring = (_tooth(scene, gear) for gear in (gears.sun, gears.planet, gears.ring))
    slant = math.cos(scene.gearset.base_helix)
    sun_planet, planet_ring = (
        ToothPair(
            first,
            second,
            mesh.path,
            contact,
            angle=normal_angle(mesh.pressure_angle, helix),
            pitch=mesh.base_pitch / slant,
        )
        for first, second, mesh in zip((sun, planet), (planet, ring), gears.meshes, strict=True)
    )
    return sun_planet, planet_ring


def _tooth(scene: Scene, gear: SpurGear) -> Tooth:
    """A tooth in its normal plane, on a body as thick as in the transverse plane."""
    oil, how = scene.lubrication, scene.mesh.tooth
    virtual = virtual_gear(gear, scene.gearset.helix_angle)
    thickness = (how.rim if gear.internal else how.hub) - 1.0
    held = 1.0 + thickness * (gear.root_radius / virtual.root_radius)
    return Tooth(virtual, Material(oil.youngs_modulus, oil.poisson_ratio), held)


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
    # A slice of the width dz has a contact line of dz/cos(beta_b). In the transverse plane, its
    # force is that of the normal plane times cos(beta_b), and its approach that over cos(beta_b).
    width = scene.gearset.face_width * math.cos(scene.gearset.base_helix)
    return tooth_stiffness(lambda s: pair.stiffness(s, width), pair.path, pair.shared_body_factor)


def _contact(scene: Scene) -> ContactLaw:
    if scene.mesh.tooth.contact == "yang_sun":
        return yang_sun
    force = abs(Layout(scene).mesh_force(scene.operating_point.input_torque))
    return weber_banaschek(max(force / scene.gearset.face_width, LIGHTEST_LINE_LOAD))
