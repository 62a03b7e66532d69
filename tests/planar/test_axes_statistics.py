"""Means and largest values of axes that move are those of NumPy, to the last bit."""

from __future__ import annotations

import numpy as np
import pytest

from planetary_twin_py import _core
from planetary_twin_py.planar.motion import AxesMotion, axes_names
from planetary_twin_py.planar.statistics import axes_statistics

PLANETS = 5


def motion(samples: int) -> AxesMotion:
    """Numbers at random of very different size, so that the order of sums shows."""
    chance = np.random.default_rng(samples)

    def numbers(*shape: int) -> np.ndarray:
        return chance.normal(size=shape) * 10.0 ** chance.uniform(-6.0, 6.0, shape)

    bodies = axes_names(PLANETS)
    moved, force = (numbers(samples, len(bodies), 2) for _ in range(2))
    flanks = numbers(samples, 2, 2 * PLANETS)
    return AxesMotion(bodies, moved, force, moved[:, :3], flanks, np.ones(PLANETS))


@pytest.mark.parametrize("samples", [1, 2, 7, 500, 5000])
def test_statistics_have_the_bits_of_numpy(samples: int) -> None:
    moving = motion(samples)
    found = axes_statistics(moving)
    for name in ("displacement", "bearing_force"):
        vectors = getattr(moving, name)
        np.testing.assert_array_equal(found[name], vectors.mean(axis=0))
        largest = np.sqrt((vectors * vectors).sum(axis=2).max(axis=0))
        np.testing.assert_array_equal(found[f"{name}_peak"], largest)
    drive, coast = moving.flank_force.mean(axis=0)
    np.testing.assert_array_equal(found["drive_force"], drive)
    np.testing.assert_array_equal(found["coast_force"], coast)
    np.testing.assert_array_equal(found["orbit"], moving.displacement[-1, :3])


def test_every_second_sample_is_read_as_it_stands() -> None:
    values = np.arange(24.0).reshape(6, 4)
    mean = np.empty(4)
    _core.column_means(values[::2], mean)
    np.testing.assert_array_equal(mean, values[::2].mean(axis=0))


def test_arrays_of_a_wrong_shape_are_refused() -> None:
    with pytest.raises(ValueError, match="column_means"):
        _core.column_means(np.ones((3, 2)), np.empty(3))
    with pytest.raises(ValueError, match="column_means"):
        _core.column_means(np.ones((0, 2)), np.empty(2))
    with pytest.raises(ValueError, match="largest_magnitudes"):
        _core.largest_magnitudes(np.ones((3, 2)), np.empty(2))


def test_what_is_not_a_number_is_no_small_magnitude() -> None:
    largest = np.empty(1)
    _core.largest_magnitudes(np.array([[3.0, 4.0], [np.nan, 0.0]]), largest)
    assert np.isnan(largest).all()
