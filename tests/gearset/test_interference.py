"""Interference: against outlines that are placed in each other, and closed forms."""

import math
from dataclasses import replace

import numpy as np
import pytest

from planetary_twin_py.gearset.gear_set import Sizes, build_gear_set
from planetary_twin_py.gearset.interference import check_fit, tip_passage
from planetary_twin_py.gearset.involute import SpurGear
from planetary_twin_py.gearset.kinematics import Teeth
from planetary_twin_py.gearset.shift import PerGear
from planetary_twin_py.gearset.working import WorkingMesh
from planetary_twin_py.tooth.undercut import check_undercut, least_shift

from .shifted_sets import SETS, STAGE_1, TWENTY, gear_set


def internal_mesh(planet, ring, addendum=1.0):
    gears = SpurGear(planet, 1e-3, TWENTY, addendum), SpurGear(ring, 1e-3, TWENTY, addendum, True)
    return WorkingMesh(*gears, 0.5e-3 * (ring - planet))


def overlap(mesh):
    """Largest depth [m] of corners of planet tips in ring teeth, over a cycle, in all positions."""
    planet, ring = mesh.first, mesh.second
    half = float(planet.half_thickness(np.array(planet.tip_radius)))
    pitch, deepest = 2.0 * math.pi / ring.teeth, -math.inf
    teeth = np.arange(planet.teeth)
    for turned in np.linspace(0.0, 1.0, 2001):
        for side in (half, -half):
            angle = 2.0 * math.pi * (teeth + turned) / planet.teeth + side
            x = mesh.centre_distance + planet.tip_radius * np.cos(angle)
            y = planet.tip_radius * np.sin(angle)
            rho = np.hypot(x, y)
            inside = rho > ring.tip_radius
            at = np.arctan2(y, x)[inside] - pitch * turned
            from_gap = np.abs(np.mod(at + 0.5 * pitch, pitch) - 0.5 * pitch)
            room = 0.5 * pitch - ring.half_thickness(rho[inside]) - from_gap
            if len(room):
                deepest = max(deepest, float((-room).max()) * ring.base_radius)
    return deepest


@pytest.mark.parametrize(
    "planet, ring, addendum",
    [(60, 65, 1.0), (60, 67, 1.0), (60, 68, 1.0), (60, 70, 1.0), (60, 80, 1.0), (30, 39, 0.8),
     (30, 35, 0.8), (30, 36, 0.8), (100, 107, 1.0), (100, 110, 1.0)],
)  # fmt: skip
def test_trochoidal_interference_is_where_outlines_overlap(planet, ring, addendum):
    mesh = internal_mesh(planet, ring, addendum)
    passage, depth = tip_passage(mesh), overlap(mesh)
    assert (passage < 0.0) == (depth > 1e-7), (passage, depth)


def test_standard_gears_need_ten_teeth_of_difference():
    """As handbooks say (JGMA: interference is avoided if z2 - z1 is larger than 9)."""
    assert tip_passage(internal_mesh(60, 70)) > 0.0
    for difference in (5, 6, 7):
        assert tip_passage(internal_mesh(60, 60 + difference)) < 0.0


@pytest.mark.parametrize("name", SETS)
def test_real_sets_fit(name):
    gears = gear_set(name)
    assert list(check_fit(gears)) == []
    assert [line for mesh in gears.meshes for line in check_undercut(mesh)] == []


def errors(sizes):
    return list(check_fit(build_gear_set(sizes)))


def test_teeth_that_overlap_are_refused_with_the_shift_that_fits():
    (line,) = errors(replace(STAGE_1, shift=PerGear(0.617, 0.802, -0.4)))
    assert line.startswith("gearset.profile_shift.planet + ring = 0.402: must be at most 0.3008")
    fits = replace(STAGE_1, shift=PerGear(0.617, 0.802, 0.3009 - 0.802))
    assert errors(fits) == []


def test_shift_of_ring_that_fits_with_the_other_sign_is_said_to():
    (line,) = errors(replace(STAGE_1, shift=PerGear(0.617, 0.802, 0.501)))
    assert line.startswith("gearset.profile_shift.planet + ring = 1.303: must be at most 0.3008")
    assert line.endswith("set gearset.profile_shift.ring = -0.501")
    assert "contact ratio" not in line
    (other,) = errors(replace(STAGE_1, shift=PerGear(0.617, 0.802, -0.4)))
    assert "set gearset.profile_shift.ring" not in other


def test_tips_that_reach_the_mating_root_are_refused():
    (line,) = errors(replace(STAGE_1, tip_diameters=(1.003, None, None)))
    assert line.startswith("gearset.tip_diameter.sun = 1003 mm: must be below 1001.32 mm")
    assert errors(replace(STAGE_1, tip_diameters=(1.0012, None, None))) == []


def test_a_contact_ratio_below_one_is_refused():
    lines = errors(replace(STAGE_1, tip_diameters=(0.94, 0.87, None)))
    assert lines[0].startswith("contact ratio of sun and planet = 0.")


def test_centres_nearer_than_the_base_circles_are_refused():
    (line, *_) = errors(replace(STAGE_1, centre_distance=0.75))
    assert line.startswith("gearset.centre_distance = 750 mm: must be above the sum of the base")


@pytest.mark.parametrize("teeth", [5, 10, 14, 17, 18, 30])
def test_least_shift_against_undercut_is_the_closed_form(teeth):
    """x = 1 - z sin^2(20 deg)/2 for a rack that is straight down to one module (ISO 21771)."""
    expected = 1.0 - 0.5 * teeth * math.sin(TWENTY) ** 2
    assert least_shift(SpurGear(teeth, 1e-3, TWENTY, 0.5)) == pytest.approx(expected, abs=2e-4)


def test_contact_where_undercut_has_removed_the_flank_is_refused():
    sizes = Sizes(Teeth(13, 25, 63), 1e-3, TWENTY, 1.0, PerGear(0.1, -0.1, 0.1))
    (line,) = check_undercut(build_gear_set(sizes).meshes[0])
    assert line.startswith("gearset.profile_shift.sun = 0.1: must be at least 0.2396 for 13 teeth")
    better = replace(sizes, shift=PerGear(0.24, -0.1, 0.1))
    assert list(check_undercut(build_gear_set(better).meshes[0])) == []
