"""What damage is counted by, as arrays for the core."""

from __future__ import annotations

import math

import numpy as np
from numpy.polynomial import Chebyshev, Polynomial

from .._core import ROOT_TERMS, SeatRating, StressCurve, Train
from ..durability.bearing_life import exponent_of
from ..durability.flash import HERTZ, Solid
from ..durability.internal_root import internal_root_stress
from ..durability.parts import MEMBERS, SHAFTS, has_root
from ..durability.root_form import root_factors
from ..durability.strength import FLANK, ROOT, Beyond
from ..durability.strength import StressCurve as Curve
from ..gearset.involute import SpurGear
from ..gearset.working import WorkingMesh
from ..lubrication.hertz import contact_modulus
from ..scene import Scene
from ..scene.durability import RatedBearing, RatedShaft, Strength

GEARS = ("sun", "planet", "ring")
SLOWEST = 4096  # mesh cycles by which a pair moves at most between two of its steps
TEST_GEAR_NOTCH = 2.0  # local over nominal stress at the root of the gears of strength tests, Y_ST


def put_durability(scene: Scene, train: Train) -> None:
    """Fill `train.durability` from the section `durability` of a scene, if it has one."""
    section = scene.durability
    if section is None:
        return
    out, gears = train.durability, scene.gearset.geometry
    out.active, out.teeth = True, section.teeth
    every = math.lcm(*scene.gearset.tooth_numbers)  # mesh cycles after which all teeth meet again
    out.counted = every * math.ceil(SLOWEST / every)
    _put_contact(scene, train)
    for n, name in enumerate(GEARS):
        strength: Strength = getattr(section.material, name)
        flank, root = _curves(strength, section.material.beyond)
        _put_curve(flank, out.flank[n])
        if has_root(scene, name):
            both_ways = section.material.reversed_bending if name == "planet" else 1.0
            _put_curve(root._replace(stress=tuple(both_ways * s for s in root.stress)), out.root[n])
    for kind, mesh in enumerate(gears.meshes):
        out.cosine[kind], out.sine[kind] = (
            math.cos(mesh.pressure_angle),
            math.sin(mesh.pressure_angle),
        )
        _put_pairs(train, kind)
        here = np.flatnonzero(train.mesh.kind[: train.meshes] == kind)
        place = 2.0 / (mesh.path.contact_ratio * mesh.base_pitch)
        out.gain[here] = place
        out.offset[here] = 2.0 * mesh.path.approach / mesh.path.contact_ratio - 1.0
        out.offset[here] -= place * mesh.curvatures[0]
        for side, name in enumerate(mesh.names):
            if has_root(scene, name):
                stress = section.face_load_factor * root_stress(scene, mesh, side)
                out.root_stress[side, :, here] = stress
    out.turns_per_cycle = 1.0 / scene.gearset.teeth.planet
    if section.bearings.planet is not None:
        _put_seat(section.bearings.planet, out.pin)
    _put_members(scene, train)
    for c, name in enumerate(SHAFTS):
        shaft: RatedShaft | None = getattr(section.shafts, name)
        if shaft is not None:
            curve = out.shaft[c]
            curve.range, curve.exponent = shaft.range, shaft.exponent
            curve.cycles = shaft.reference_cycles


def _curves(strength: Strength, beyond: Beyond) -> tuple[Curve, Curve]:
    """S-N curves of flank and root of a gear."""
    shape = strength.treatment
    root = TEST_GEAR_NOTCH * strength.root
    return FLANK[shape].curve(strength.flank, beyond), ROOT[shape].curve(root, beyond)


def _put_curve(curve: Curve, out: StressCurve) -> None:
    count = len(curve.cycles)
    out.points, out.endless = count, curve.beyond == "endless"
    out.log_stress[:count] = np.log(curve.stress)
    out.log_cycles[:count] = np.log(curve.cycles)


def _put_contact(scene: Scene, train: Train) -> None:
    """Factors of the contact stress and of the flash temperature."""
    data, width, out = scene.lubrication, scene.gearset.face_width, train.durability
    assert scene.durability is not None
    load = scene.durability.face_load_factor
    modulus = contact_modulus(data.youngs_modulus, data.poisson_ratio)
    line = 1.0 / math.cos(scene.gearset.base_helix)
    out.pressure = load * modulus / (math.pi * width * line)
    solid = Solid(data.solid_conductivity, data.solid_density, data.solid_heat_capacity)
    band = (16.0 / (math.pi * width * modulus)) ** 0.25  # sqrt(2 b) of R F = 1 N m
    out.heat = HERTZ * load**0.75 / (width * solid.contact_coefficient * band)


def _put_pairs(train: Train, kind: int) -> None:
    """Whole distances at which a pair may be from the first one."""
    teeth = train.teeth
    places = [
        math.floor(shift)
        for segment in range(int(teeth.segments[kind]))
        for shift in teeth.shift[kind, segment, : int(teeth.present[kind, segment])]
    ]
    train.durability.first_pair[kind] = min(places)
    train.durability.pairs[kind] = max(places) - min(places) + 1


def root_stress(scene: Scene, mesh: WorkingMesh, side: int) -> np.ndarray:
    """Stress at the root of a gear over the normal load [1/m^2], a polynomial.

    ISO 6336-3 method B factors, of internal teeth boundary elements, with the load at the actual
    position of the pair. Beyond the path of contact, where the tip corner touches, it is at its
    end.

    Returns:
        Coefficients of the position from -1 to 1 over the path of contact, (ROOT_TERMS,).
    """
    gear: SpurGear = (mesh.first, mesh.second)[side]
    sense = 1.0 if side == 0 or mesh.internal else -1.0

    def stress(place: np.ndarray) -> np.ndarray:
        middle, half = 0.5 * (low + high), 0.5 * (high - low)
        along = mesh.curvatures[side] + sense * (middle + half * place) * mesh.base_pitch
        radius = np.array([math.hypot(gear.base_radius, rho) for rho in along])
        within = np.maximum if gear.internal else np.minimum
        return _over_load(scene, gear, within(radius, gear.tip_radius))

    low, high = -mesh.path.approach, mesh.path.recess
    fitted = Chebyshev.interpolate(stress, ROOT_TERMS - 1)
    coefficients: np.ndarray = fitted.convert(kind=Polynomial).coef
    return np.pad(coefficients, (0, ROOT_TERMS - len(coefficients)))


def _over_load(scene: Scene, gear: SpurGear, radius: np.ndarray) -> np.ndarray:
    """Stress at the root over the normal load [1/m^2] at radii of the flank [m], (n,)."""
    width = scene.gearset.face_width
    if gear.internal:
        rim, poisson = scene.mesh.tooth.rim, scene.lubrication.poisson_ratio
        return internal_root_stress(gear, rim, poisson, radius) / width
    per_load = math.cos(gear.pressure_angle) / (width * gear.module)
    found = []
    for at in radius.tolist():
        factors = root_factors(gear, at)
        found.append(per_load * factors.form * factors.correction)
    return np.array(found)


def _put_members(scene: Scene, train: Train) -> None:
    """Bearings of the members in the housing, which have loads where axes move."""
    assert scene.durability is not None
    for b, member in enumerate(MEMBERS):
        bearing: RatedBearing | None = getattr(scene.durability.bearings, member)
        if bearing is not None and scene.moving_axes:
            _put_seat(bearing, train.durability.member[b])


def _put_seat(bearing: RatedBearing, seat: SeatRating) -> None:
    seat.rating = bearing.number * bearing.rating
    seat.exponent = exponent_of(bearing.kind)
    seat.balls = bearing.kind == "ball"
    if bearing.fatigue_limit is not None and bearing.mean_diameter is not None:
        seat.limit = bearing.cleanliness * bearing.number * bearing.fatigue_limit
        seat.diameter = bearing.mean_diameter
