"""A torque transducer: errors, bandwidth and range."""

import math

import numpy as np
import pytest

from planetary_twin_py.model.layout import Layout
from planetary_twin_py.sensors.bank import SensorBank
from sensors.prescribed import line, read, scene_with, times, turning

RATE = 6400.0


def transduced(torques, **own):
    """Readings of a transducer under torques of the machines, functions of the time."""
    scene = scene_with({"kind": "torque", "rate": RATE, **own})
    time = times(SensorBank(Layout(scene)), 0.5)
    torque = np.stack([each(time) for each in torques], axis=1)
    return read(scene, turning(scene, time, 1.0, torque=torque))[0]


def steady(value):
    return lambda time: np.full(len(time), value)


def test_zero_and_gain_are_errors_of_the_reading():
    torques = steady(63.0), steady(-360.0)
    for shaft, true in (("input", 63.0), ("output", -360.0)):
        found = transduced(torques, shaft=shaft, zero=0.03, gain=5e-4)
        assert found.values == pytest.approx(true * 1.0005 + 0.03, rel=1e-6)
        assert found.unit == "N m"


@pytest.mark.parametrize("tone", [100.0, 1000.0, 2000.0])
def test_the_bandwidth_is_that_of_a_butterworth_filter(tone):
    """1 / sqrt(1 + (f/f_c)^4)."""
    found = transduced((lambda t: np.cos(math.tau * tone * t), steady(0.0)), bandwidth="1 kHz")
    expected = 1.0 / math.sqrt(1.0 + (tone / 1000.0) ** 4)
    assert abs(line(found.values, RATE, tone)) == pytest.approx(expected, rel=1e-3)


def test_a_torque_beyond_the_range_is_clipped_and_counted():
    found = transduced((steady(63.0), steady(0.0)), range=50.0, bits=12)
    assert np.all(found.values == 50.0) and found.clipped == len(found.values) > 1000


def test_bits_divide_twice_the_range():
    found = transduced((lambda t: 40.0 * t, steady(0.0)), range=50.0, bits=8)
    steps = found.values / (100.0 / 256)
    assert steps == pytest.approx(np.round(steps), abs=1e-9)
    assert np.unique(steps).size == pytest.approx(20.0 * 256 / 100.0, abs=2)


def test_noise_is_that_of_a_sample():
    found = transduced((steady(0.0), steady(0.0)), noise=0.2)
    assert np.std(found.values) == pytest.approx(0.2, rel=0.05)
