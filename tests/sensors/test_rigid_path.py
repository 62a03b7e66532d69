"""Acceleration of a rigid ring, against circles that its axis runs through."""

import math

import numpy as np
import pytest

from planetary_twin_py.model.layout import Layout
from planetary_twin_py.sensors.bank import SensorBank
from sensors.prescribed import line, line_of, moving, read, times, turning

TURN, RATE, RADIUS = 8.0, 16_000.0, 0.1
SENSOR = {"kind": "accelerometer", "rate": RATE, "angle": 0.4, "oversampling": 4}


def felt(direction, housing, twist=None, **own):
    """Readings while the ring moves by x + i y in the housing [m], and turns by `twist` [rad/s]."""
    path = {"law": "rigid", "radius": RADIUS}
    scene = moving({**SENSOR, "direction": direction, "path": path, **own})
    time = times(SensorBank(Layout(scene)), 0.6)
    turned = housing(time) * np.exp(-1j * math.tau * TURN * time)  # in the frame of the carrier
    moved = np.zeros((len(time), 6, 2))
    moved[:, 1] = np.stack([turned.real, turned.imag], axis=1)
    sensed = turning(scene, time, math.tau * TURN, displacement=moved)
    if twist is not None:
        sensed.speed[:, -2] = twist(time)
    (readings,) = read(scene, sensed)
    return readings


@pytest.mark.parametrize("order", [90, 183, 363])
@pytest.mark.parametrize("way", [1.0, -1.0])
@pytest.mark.parametrize("direction", ["radial", "tangential"])
def test_a_circle_is_felt_with_its_centripetal_acceleration(direction, way, order):
    """w^2 e, in the phase of the place of the sensor, forwards or backwards."""
    omega, size = math.tau * TURN * order, 1e-6
    readings = felt(direction, lambda time: size * np.exp(1j * way * omega * time))
    axis = 0.4 + (0.5 * math.pi if direction == "tangential" else 0.0)
    expected = -size * omega**2 * np.exp(-1j * way * axis)
    found = line_of(readings, TURN * order)
    assert abs(found - expected) < 1e-3 * abs(expected)


def test_a_tangential_sensor_feels_the_ring_turn():
    """R times the angular acceleration; a radial one does not feel it."""

    def twist(time):
        return 2.0 * np.sin(math.tau * 700.0 * time)

    def still(time):
        return np.zeros(len(time), dtype=complex)

    across, along = (felt(way, still, twist).values for way in ("tangential", "radial"))
    expected = 2.0 * math.tau * 700.0 * RADIUS
    assert abs(line(across, RATE, 700.0)) == pytest.approx(expected, rel=1e-3)
    assert not np.any(along)


@pytest.mark.parametrize("near", [3000.0, 6000.0])
def test_a_circle_above_the_samples_is_hardly_an_alias(near):
    """Positions at 64 kHz hide what is near 64 kHz by the square of the ratio of frequencies."""
    own = 4.0 * RATE - near
    readings = felt("radial", lambda time: np.cos(math.tau * own * time) / (math.tau * own) ** 2)
    found = abs(line(readings.values, RATE, near))
    assert found == pytest.approx(math.cos(0.4) * (near / own) ** 2, rel=0.01)
