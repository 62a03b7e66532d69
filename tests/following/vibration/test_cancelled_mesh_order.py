"""The scale of the speed is found where the planets cancel the first mesh orders."""

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.following.train import followed_train
from planetary_twin_py.following.vibration.lines import HARMONICS, PatternAmplitudes

TRAIN = followed_train(pt.load_scene("paper"))
RATE = 10_000.0


def amplitudes(orders, gain):
    """Of one hunting period at 500 Hz, from a measured speed with this gain that wanders."""
    cycles = TRAIN.hunting_cycles
    time = np.arange(0.0, cycles / 500.0, 1.0 / RATE)
    mesh = 2.0 * np.pi * 500.0 * (time + 1e-3 * np.sin(2.0 * np.pi * time))
    tones = sum(np.sin(order * mesh + order) for order in orders)
    tones += 0.01 * np.random.default_rng(0).standard_normal(len(time))
    patterns = PatternAmplitudes(TRAIN)
    return patterns.of(gain * mesh / abs(float(TRAIN.cycles)), tones[:, None], HARMONICS + 1.0)


@pytest.mark.parametrize("orders", [(1,), (2,), (3,), (2, 3), (1, 2, 3)])
@pytest.mark.parametrize("gain", [0.9985, 1.0, 1.001])
def test_lowest_mesh_order_that_sensor_shows_scales_the_speed(orders, gain):
    found, _ = amplitudes(orders, gain)
    for order in range(1, HARMONICS + 1):
        assert found[0, order - 1] == pytest.approx(float(order in orders), abs=0.03)


@pytest.mark.parametrize("orders", [(1,), (3,)])
@pytest.mark.parametrize("gain", [0.996, 1.004])
def test_a_speed_that_does_not_fit_any_mesh_order_is_not_used(orders, gain):
    assert amplitudes(orders, gain) is None
