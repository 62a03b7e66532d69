"""Slow gears, whose friction reverses within a small range of speeds."""

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.units.conversion import rpm

SLOW = pt.load_scene("paper").replace(input_speed=rpm(20))
THREE_CYCLES = 0.3  # [s]


@pytest.fixture(scope="module")
def expected():
    """Transmission errors by the other method alone."""
    return pt.simulate(SLOW, THREE_CYCLES, 1e4, tolerance=1e-5, method="rosenbrock").dte


@pytest.mark.parametrize("tolerance", [1e-3, 1e-2])
def test_most_steps_are_collocation_with_small_errors(expected, tolerance):
    run = pt.simulate(SLOW, THREE_CYCLES, 1e4, tolerance=tolerance, method="march")
    assert run.stats.stiff_steps < 0.5 * run.stats.steps
    assert np.abs(run.dte - expected).max() < 0.1 * tolerance * np.abs(expected).max()
