"""Mesh phases and assembly of the paper's gearset."""

import math

import numpy as np
import pytest

from planetary_twin_py.gearset.kinematics import Teeth
from planetary_twin_py.gearset.phasing import check_assembly, mesh_phases, nearest_assembly

PAPER = Teeth(30, 20, 70)
FITTING = np.radians([90.0, -28.8, 208.8])


def test_phases_of_the_papers_planets():
    sun, ring = np.mod(mesh_phases(PAPER, FITTING), 1.0)
    assert sun == pytest.approx([0.0, 0.1, 0.9], abs=1e-9)
    assert ring == pytest.approx([0.5, 0.6, 0.4], abs=1e-9)


def test_sun_and_ring_mesh_of_a_planet_keep_their_distance_in_any_position_that_fits():
    """The planet's own teeth tie its two meshes together: half a cycle, or none if odd."""
    for teeth, offset in ((PAPER, 0.5), (Teeth(21, 39, 99), 0.0)):
        angles = [2 * math.pi * k / (teeth.sun + teeth.ring) for k in (0, 17, 41, 66)]
        sun, ring = np.array(mesh_phases(teeth, angles))
        beyond = ring - sun - offset
        assert beyond == pytest.approx(np.round(beyond), abs=1e-9)


def test_three_planets_at_120_degrees_are_refused_with_the_nearest_that_fit():
    with pytest.raises(ValueError, match=r"nearest: 90, -28\.8, 208\.8 deg") as error:
        check_assembly(PAPER, np.radians([90.0, -30.0, 210.0]))
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("planets", [2, 4, 5])
def test_equal_spacing_fits_where_it_divides_the_teeth_of_sun_and_ring(planets):
    check_assembly(PAPER, [2 * math.pi * k / planets for k in range(planets)])


def test_what_is_offered_fits():
    check_assembly(PAPER, nearest_assembly(PAPER, [0.3, 2.0, 4.4, 5.1]))
