"""Gears with profile shift: published gear sets, ISO 21771, and teeth placed against each other."""

import math

import numpy as np
import pytest

from planetary_twin_py.gearset.gear_set import Sizes, build_gear_set, distance_without_play
from planetary_twin_py.gearset.kinematics import Teeth
from planetary_twin_py.gearset.mount import mount
from planetary_twin_py.gearset.phasing import mesh_phases
from planetary_twin_py.gearset.shift import PerGear, inverse_involute, involute

from .shifted_sets import LJUBLJANA, SETS, STAGE_1, STAGE_2, TWENTY, gear_set

ALL = pytest.mark.parametrize("name", SETS)
MESHES = pytest.mark.parametrize("kind", [0, 1])


@pytest.mark.parametrize("angle", [1e-3, 0.05, 0.3, 0.6, 1.0, 1.4])
def test_the_inverse_of_the_involute_function(angle):
    assert inverse_involute(involute(angle)) == pytest.approx(angle, rel=1e-12)


@pytest.mark.parametrize("sizes, distance", [(STAGE_1, 863.0), (STAGE_2, 584.0)])
def test_published_shifts_give_the_published_centre_distance(sizes, distance):
    """Shifts have three digits: 0.0005 of 45 mm is 0.02 mm."""
    for ring in (False, True):
        assert 1e3 * distance_without_play(sizes, ring) == pytest.approx(distance, abs=0.02)


@pytest.mark.parametrize(
    "sizes, alteration", [(STAGE_1, (-10.861, -10.861, 0.0)), (STAGE_2, (-1.75, -1.75, 0.0))]
)
def test_tip_alterations_are_those_of_kisssoft(sizes, alteration):
    """As listed with the data of Nejad et al. 2016 in the public code of G. Reboucas [mm]."""
    gears = build_gear_set(sizes)
    for gear, expected in zip((gears.sun, gears.planet, gears.ring), alteration, strict=True):
        found = 1e3 * gear.module * (gear.addendum - 1.0)
        assert found == pytest.approx(expected, abs=0.007)


@pytest.mark.parametrize("sun, planet", [(0.26, 0.25), (0.3, 0.1), (0.437, 0.043)])
def test_shifts_without_play_have_a_backlash_of_exactly_zero(sun, planet):
    """The ring has the centre distance of the sun: x_planet + x_ring = -(x_sun + x_planet)."""
    shift = PerGear(sun, planet, -sun - 2.0 * planet)
    gears = build_gear_set(Sizes(Teeth(30, 20, 70), 0.8e-3, TWENTY, 1.0, shift))
    assert [mesh.backlash for mesh in gears.meshes] == [0.0, 0.0]
    wider = shift._replace(ring=shift.ring - 1e-6)
    wider = build_gear_set(Sizes(Teeth(30, 20, 70), 0.8e-3, TWENTY, 1.0, wider))
    assert wider.meshes[1].backlash > 0.0


def test_published_tip_diameters():
    gears = build_gear_set(LJUBLJANA)
    found = [2e3 * gear.tip_radius for gear in (gears.sun, gears.planet, gears.ring)]
    assert found == pytest.approx([41.7008, 78.8170, 185.4992], abs=1e-3)


@pytest.mark.parametrize("gear, span, length", [("sun", 3, 13.9546), ("planet", 5, 24.3530)])
def test_published_base_tangent_lengths(gear, span, length):
    """W_k = (k - 1) p_b + s_b: the thickness of shifted teeth."""
    found = getattr(build_gear_set(LJUBLJANA), gear)
    base = found.base_radius
    pitch = math.pi * found.module * math.cos(found.pressure_angle)
    thick = 2.0 * base * float(found.half_thickness(np.array(base)))
    assert 1e3 * ((span - 1) * pitch + thick) == pytest.approx(length, abs=1e-4)


@ALL
@MESHES
def test_contact_ratio_of_iso_6336(name, kind):
    """eps = (z1 (tan a_a1 - tan a_w) +- z2 (tan a_a2 - tan a_w))/2 pi, a_a at the tips."""
    mesh = gear_set(name).meshes[kind]
    inner, outer = mesh.first, mesh.second
    distance = 0.5 * inner.module * (outer.teeth + (-1 if kind else 1) * inner.teeth)
    working = math.acos(distance * math.cos(inner.pressure_angle) / mesh.centre_distance)
    tips = [math.tan(math.acos(gear.base_radius / gear.tip_radius)) for gear in (inner, outer)]
    first = inner.teeth * (tips[0] - math.tan(working))
    second = outer.teeth * (tips[1] - math.tan(working)) * (-1 if kind else 1)
    assert mesh.path.recess == pytest.approx(first / (2.0 * math.pi), rel=1e-9)
    assert mesh.path.approach == pytest.approx(second / (2.0 * math.pi), rel=1e-9)


def unwound(gear, count=20001):
    """One flank as the end of a string unwound from the base circle, at angle zero there.

    Returns the polar angle as a function of the radius.
    """
    roll = np.linspace(0.0, 1.6, count)
    x = gear.base_radius * (np.cos(roll) + roll * np.sin(roll))
    y = gear.base_radius * (np.sin(roll) - roll * np.cos(roll))
    return lambda radius: np.interp(radius, np.hypot(x, y), np.arctan2(y, x))


@ALL
@MESHES
def test_coast_flank_follows_by_thickness_on_the_working_circle(name, kind):
    """Thickness of the first gear's tooth and of the second gear's gap, half of each."""
    mesh = gear_set(name).meshes[kind]
    arcs = []
    for gear, working in zip((mesh.first, mesh.second), mesh.pitch_radii, strict=True):
        wide = 0.25 * math.pi + gear.profile_shift * math.tan(gear.pressure_angle)
        lean = unwound(gear)(np.array([gear.pitch_radius, working]))
        thinner = (lean[1] - lean[0]) * (-1.0 if gear.internal else 1.0)
        arcs.append(2.0 * working * (gear.module * wide / gear.pitch_radius - thinner))
    pitch = 2.0 * math.pi * mesh.pitch_radii[0] / mesh.first.teeth
    expected = 0.5 * (arcs[0] + pitch - arcs[1]) / pitch
    assert mesh.coast_lead == pytest.approx(expected, abs=1e-6)


@ALL
def test_phases_are_those_of_the_mounted_gears(name):
    """When the sun has turned by n + phase teeth, the pitch point is at a leading flank."""
    sizes, gears = SETS[name], gear_set(name)
    teeth, step = sizes.teeth, 2.0 * math.pi / (sizes.teeth.sun + sizes.teeth.ring)
    angles = [0.3, 0.3 + step * (sum(teeth) // 7), 0.3 + step * (sum(teeth) // 3)]
    leads = tuple(mesh.coast_lead for mesh in gears.meshes)
    stand = mount(teeth, angles, leads[0])
    sun_phases, ring_phases = mesh_phases(teeth, angles, leads)
    for i, psi in enumerate(angles):
        # Carrier at rest; in units of turns. The tooth's leading flank is half its lead ahead.
        cycle = float(sun_phases[i])
        sun = stand.sun + 2.0 * math.pi * cycle / teeth.sun
        ahead = (sun - psi) * teeth.sun / (2.0 * math.pi) + 0.5 * leads[0]
        assert ahead == pytest.approx(round(ahead), abs=1e-9)
        cycle = float(ring_phases[i])
        # The sun turns counter-clockwise and the planet clockwise: its leading flank faces back.
        planet = stand.planets[i] - 2.0 * math.pi * cycle / teeth.planet
        ahead = (psi - planet) * teeth.planet / (2.0 * math.pi) + 0.5 * leads[1]
        assert ahead == pytest.approx(round(ahead), abs=1e-9)


def test_a_positive_shift_thickens_teeth_and_moves_tips():
    plain = build_gear_set(Sizes(Teeth(30, 20, 70), 1e-3, TWENTY))
    moved = build_gear_set(Sizes(Teeth(30, 20, 70), 1e-3, TWENTY, 1.0, PerGear(0.3, -0.3, 0.3)))
    at = np.array(plain.ring.pitch_radius)
    assert moved.ring.half_thickness(at) > plain.ring.half_thickness(at)
    assert moved.ring.tip_radius == pytest.approx(plain.ring.tip_radius - 0.3e-3)
    assert moved.sun.tip_radius == pytest.approx(plain.sun.tip_radius + 0.3e-3)
    assert moved.centre_distance == plain.centre_distance
    assert [mesh.backlash for mesh in moved.meshes] == [0.0, 0.0]


def test_carrier_ratio_is_that_of_the_base_circles():
    gears = gear_set("31/31/95")
    sun, planet, ring = (g.base_radius for g in (gears.sun, gears.planet, gears.ring))
    assert gears.carrier_ratio == pytest.approx((ring - planet) / (sun + planet), rel=1e-14)
    for mesh, reach in zip(gears.meshes, (sun + planet, ring - planet), strict=True):
        assert reach == pytest.approx(gears.centre_distance * math.cos(mesh.pressure_angle))
