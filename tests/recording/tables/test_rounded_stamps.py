"""Stamps at equal steps that are rounded are even; stamps with a missing or doubled row are not."""

import numpy as np
import pytest

from planetary_twin_py.recording.tables.rounded_stamps import rounded_grid
from planetary_twin_py.recording.tables.time_steps import time_step

STEP = 0.0390625  # [ms] at 25.6 kHz
EVEN = STEP * np.arange(5000)


def rounded(time):
    return np.round(time, 2)  # to 0.01 ms


@pytest.mark.parametrize("begin", [0.0, 0.007, 1234.5])
def test_the_grid_of_rounded_stamps_is_within_half_a_digit(begin):
    stamps = rounded(begin + EVEN)
    grid = rounded_grid(stamps)
    assert grid.digit == pytest.approx(0.01)
    assert np.abs(grid.time - stamps).max() < 0.0051
    assert np.abs(grid.time - begin - EVEN).max() < 5e-4
    assert time_step(stamps) == pytest.approx(STEP, rel=1e-6)


@pytest.mark.parametrize("row", [1, 50, 2500, 4990, 4998])
def test_a_missing_or_a_doubled_row_is_no_rounding(row):
    for stamps in (np.delete(EVEN, row), np.insert(EVEN, row, EVEN[row])):
        assert rounded_grid(rounded(stamps)) is None
        with pytest.raises(ValueError, match="previous row"):
            time_step(rounded(stamps))


def test_a_digit_as_coarse_as_the_steps_is_refused():
    assert rounded_grid(np.round(0.07 * np.arange(5000), 1)) is None


def test_stamps_that_vary_by_more_than_their_digit_are_not_even():
    shaken = EVEN + 0.3 * STEP * np.random.default_rng(0).uniform(-1.0, 1.0, len(EVEN))
    assert rounded_grid(rounded(shaken)) is None


@pytest.mark.parametrize("step", [0.1, 0.001, 0.0625])
def test_exact_stamps_stay_as_they_are(step):
    assert rounded_grid(np.round(step * np.arange(1000), 4)) is None
