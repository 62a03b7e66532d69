"""Mesh phases and assembly of the paper's gearset, and of others."""

import math
import re
from fractions import Fraction

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.gearset.kinematics import Teeth
from planetary_twin_py.gearset.phasing import (
    assembled,
    check_assembly,
    mesh_phases,
    nearest_assembly,
)
from planetary_twin_py.model.layout import Layout

PAPER = Teeth(30, 20, 70)
FITTING = np.radians([90.0, -28.8, 208.8])


def test_phases_of_the_papers_planets():
    sun, ring = ([phase % 1 for phase in phases] for phases in mesh_phases(PAPER, FITTING))
    assert sun == [0, Fraction(1, 10), Fraction(9, 10)]
    assert ring == [Fraction(1, 2), Fraction(3, 5), Fraction(2, 5)]


def test_phases_are_those_of_a_position_of_assembly():
    angles = [90.0, -28.8000001, 208.7999999]
    assert mesh_phases(PAPER, np.radians(angles)) == mesh_phases(PAPER, FITTING)


def test_sun_and_ring_mesh_keep_their_phase_difference():
    """The planet's own teeth couple its two meshes: half a cycle, or none if odd."""
    for teeth, offset in ((PAPER, Fraction(1, 2)), (Teeth(21, 39, 99), Fraction(0))):
        angles = [2 * math.pi * k / (teeth.sun + teeth.ring) for k in (0, 17, 41, 66)]
        pairs = zip(*mesh_phases(teeth, angles), strict=True)
        assert all((ring - sun - offset).denominator == 1 for sun, ring in pairs)


def test_planets_that_do_not_fit_are_refused_with_the_nearest():
    with pytest.raises(ValueError, match=r"nearest: 90, -28\.8, 208\.8 deg") as error:
        check_assembly(PAPER, np.radians([90.0, -30.0, 210.0]))
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("planets", [2, 4, 5])
def test_equal_spacing_fits_where_it_divides_the_teeth(planets):
    check_assembly(PAPER, [2 * math.pi * k / planets for k in range(planets)])


def suggested(teeth, degrees):
    """Angles [rad] that a user copies out of the refusal."""
    with pytest.raises(ValueError, match="cannot be assembled") as error:
        check_assembly(teeth, np.radians(degrees))
    refused, fitting = re.findall(r"([-\d., ]+) deg", str(error.value))
    assert refused.strip() != fitting.strip()
    return np.radians([float(angle) for angle in fitting.split(",")])


@pytest.mark.parametrize(
    "teeth, degrees",
    [
        (Teeth(27, 35, 99), (0.0, 90.0, 180.0, 270.0)),  # OH-58
        (Teeth(27, 35, 99), (0.0, 88.584, 180.0, 268.584)),  # beyond the tolerance by 25 %
        (Teeth(30, 20, 70), (90.0, -30.0, 210.0)),  # Salagianni et al. 2017
        (Teeth(20, 31, 83), (math.pi, 123.0, 243.0)),
        (Teeth(1000, 1000, 3000), (0.0, 120.03, 240.0)),  # most teeth of a scene
    ],
)
def test_the_printed_positions_are_accepted_when_copied(teeth, degrees):
    check_assembly(teeth, suggested(teeth, degrees))


@pytest.mark.parametrize("teeth", [Teeth(27, 35, 99), Teeth(29, 71, 171), Teeth(31, 31, 94)])
def test_angles_rounded_to_hundredth_of_degree_are_exact_ones(teeth):
    exact = nearest_assembly(teeth, [0.0, 1.3, 2.6, 3.9])
    rounded = [math.radians(round(math.degrees(angle), 2)) for angle in exact]
    check_assembly(teeth, rounded)
    assert assembled(teeth, rounded) == pytest.approx(exact, rel=1e-15)
    assert assembled(teeth, exact) == exact


def test_equal_planets_at_rounded_angles_are_one_group():
    teeth = {"sun": 30, "planet": 21, "ring": 72}
    angles = ["0 deg", "119.99 deg", "240.01 deg"]
    scene = pt.load_scene("paper").replace(
        **{"gearset.teeth": teeth, "gearset.planet_angles": angles}
    )
    assert scene.gearset.planet_angles == pytest.approx((0.0, math.tau / 3, math.tau / 1.5), 1e-15)
    assert Layout(scene).groups.sizes == (3,)
    assert Layout(scene).axes_stand


def test_no_positions_are_suggested_at_which_planets_touch():
    """At 52.7 deg they clear by 0.2 modules; at 50.4 deg, a valid position, they overlap."""
    with pytest.raises(ValueError, match="planets touch each other") as error:
        check_assembly(PAPER, np.radians([0.0, 52.7, 105.4]))
    assert "nearest:" not in str(error.value)
