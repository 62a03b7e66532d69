"""A thermometer that follows the oil with a lag."""

import math

import numpy as np
import pytest

from sensors.prescribed import read, scene_with, turning

RATE = 10.0


def followed(oil, duration, **own):
    scene = scene_with({"kind": "thermometer", "rate": RATE, "time_constant": 5.0, **own})
    time = np.arange(round(duration * RATE)) / RATE
    oil = oil if isinstance(oil, float) else oil(time)
    return read(scene, turning(scene, time, 1.0, oil_temperature=oil))[0]


def test_a_step_is_followed_with_the_time_constant():
    """20 K after 3 s: 1 - exp(-t/T), with the oil of each sample held until the next one."""
    found = followed(lambda t: np.where(t < 3.0, 330.0, 350.0), 20.0)
    since = np.maximum(found.time - 3.0 + 1.0 / RATE, 0.0)
    expected = 330.0 + 20.0 * (1.0 - np.exp(-since / 5.0))
    assert found.values == pytest.approx(expected, abs=1e-9)
    assert found.unit == "K"


def test_a_constant_temperature_is_read_from_the_start():
    assert followed(345.0, 3.0).values == pytest.approx(345.0)


def test_noise_is_that_of_a_sample():
    found = followed(345.0, 200.0, noise=0.1)
    assert np.std(found.values) == pytest.approx(0.1, rel=0.05)
    assert math.isclose(found.values.mean(), 345.0, abs_tol=0.01)
