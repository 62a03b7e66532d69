"""The sun, averaged over its meshes with all planets that pass a sensor."""

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.analysis.gears.separated_condition import of_all_planets
from planetary_twin_py.gearset.kinematics import Teeth

TEETH, TOOTH, NOISE = Teeth(17, 37, 91), 5, 0.3
ANGLES = np.array([0.0, 2.0, 4.3])  # of the planets [rad]


def measured(sense):
    """Meshing of the sun with each planet, a burst at one of its teeth, and noise."""
    turned = 0.3 + 2.0 * np.pi / (40 * TEETH.ring) * np.arange(int(38.2 * 40 * TEETH.ring))
    passed = TEETH.ring * turned / (2.0 * np.pi)
    signal = NOISE * np.random.default_rng(1).normal(size=len(turned))
    for angle in sense * ANGLES:
        tooth = passed - TEETH.sun * angle / (2.0 * np.pi)  # of the sun, in mesh with this planet
        away = (tooth - TOOTH + 8.5) % TEETH.sun - 8.5
        weight = np.cos(0.5 * (turned + angle)) ** 8
        burst = np.exp(-((away / 0.4) ** 2)) * np.cos(2.0 * np.pi * 3.3 * away)
        signal += weight * (np.cos(2.0 * np.pi * tooth) + burst)
    return signal, sense * turned


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_bursts_of_a_tooth_in_all_meshes_are_at_the_same_place(sense):
    signal, angle = measured(sense)
    every = [pt.separate(signal, angle, TEETH, 3, "sun", passing=-one) for one in ANGLES]
    found = of_all_planets(every, sense * ANGLES, TEETH)
    parts = [pt.gear_signals(one.average, TEETH.sun).difference for one in (every[0], found)]
    at = found.tooth[np.abs(parts[1]).argmax()]
    assert at == pytest.approx((TOOTH - TEETH.ring) % TEETH.sun, abs=0.1)
    assert np.abs(parts[1]).max() == pytest.approx(np.abs(parts[0]).max(), rel=0.2)
    quiet = np.abs((found.tooth - at + 8.5) % 17.0 - 8.5) > 2.0
    noise = [part[quiet].std() for part in parts]
    assert noise[1] == pytest.approx(noise[0] / np.sqrt(3.0), rel=0.3)
    assert found.passes == sum(one.passes for one in every)
