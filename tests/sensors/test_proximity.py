"""A proximity probe, against a shaft that runs through an ellipse in the housing."""

import math

import numpy as np
import pytest

from planetary_twin_py.model.layout import Layout
from planetary_twin_py.sensors.bank import SensorBank
from sensors.prescribed import moving, read, times, turning

ROWS = {"sun": 0, "ring": 1, "carrier": 2}


@pytest.mark.parametrize("body", ROWS)
@pytest.mark.parametrize("angle", [0.0, 2.0])
def test_a_probe_sees_the_way_towards_it_in_the_housing(body, angle):
    scene = moving({"kind": "proximity", "body": body, "angle": angle})
    time = times(SensorBank(Layout(scene)), 0.2)
    omega, turn = math.tau * 200.0, 40.0
    way = 3e-6 * np.cos(omega * time) + 1j * (1e-6 * np.sin(omega * time) + 2e-6)
    turned = way * np.exp(-1j * turn * time)
    moved = np.zeros((len(time), 6, 2))
    moved[:, ROWS[body]] = np.stack([turned.real, turned.imag], axis=1)
    (readings,) = read(scene, turning(scene, time, turn, displacement=moved))
    at = omega * readings.time
    expected = math.cos(angle) * 3e-6 * np.cos(at)
    expected = expected + math.sin(angle) * (1e-6 * np.sin(at) + 2e-6)
    assert readings.unit == "m"
    assert readings.values == pytest.approx(expected, abs=2e-9)
