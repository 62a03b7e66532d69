"""The size of a change is as uncertain as its shape is unlike the signature."""

import numpy as np
import pytest

from planetary_twin_py.following.teeth.shape_error import LEAST, PER_SHAPE, shape_error

SIGNATURE = np.random.default_rng(0).standard_normal((30, 20))
OTHER = np.random.default_rng(1).standard_normal((30, 20))
OTHER -= SIGNATURE * np.sum(OTHER * SIGNATURE) / np.sum(SIGNATURE**2)
OTHER *= np.sqrt(np.sum(SIGNATURE**2) / np.sum(OTHER**2))


def blocks(count, change, noise, seed=2):
    """Residuals of hunting periods of 14 turns of the gear."""
    chance = np.random.default_rng(seed)
    return np.tile(change, (14, 1)) + noise * chance.standard_normal((count, 420, 20))


@pytest.mark.parametrize("tangent", [0.0, 0.5, 1.5])
@pytest.mark.parametrize("noise", [0.0, 1.0])
def test_error_of_a_size_is_the_tangent_of_its_shape(tangent, noise):
    after = blocks(16, 0.7 * (SIGNATURE + tangent * OTHER), noise)
    before = blocks(4, 0.0 * SIGNATURE, noise, 3)
    expected = np.hypot(LEAST, PER_SHAPE * tangent)
    assert shape_error(SIGNATURE, after, before, 24) == pytest.approx(expected, abs=0.04)


def test_a_change_that_noise_hides_is_uncertain():
    few = shape_error(
        SIGNATURE, blocks(1, 0.05 * SIGNATURE, 1.0), blocks(4, SIGNATURE * 0, 1.0), 24
    )
    many = shape_error(
        SIGNATURE, blocks(32, 0.05 * SIGNATURE, 1.0), blocks(4, SIGNATURE * 0, 1.0), 24
    )
    assert many < 0.6 * few
