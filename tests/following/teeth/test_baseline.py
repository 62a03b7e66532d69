"""What a baseline learns of the torque: nothing from noise, and the slope of a runout."""

import numpy as np
import pytest

from planetary_twin_py.following.teeth.baseline import Baseline
from planetary_twin_py.following.teeth.hunting_blocks import BINS, HuntingBlock
from planetary_twin_py.following.teeth.scores import Bank
from planetary_twin_py.following.teeth.signatures import Signatures

CYCLES, BLOCKS, TORQUE, NOISE = 35, 24, 63.0, 5e-8  # [N m], [m]


def learned(seed, pattern, wander):
    """A baseline of white noise and a pattern that is proportional to the torque."""
    chance = np.random.default_rng(seed)
    gears = {"sun": 5, "ring": 7}
    shapes = {gear: 1e-5 * chance.standard_normal((n, BINS)) for gear, n in gears.items()}
    cell = Baseline(TORQUE, 104.0, 1, BLOCKS, Bank(Signatures(TORQUE, shapes, 1e-8)))
    everywhere = np.ones((CYCLES, BINS), dtype=bool)
    for n, torque in enumerate(TORQUE + wander * chance.standard_normal(BLOCKS)):
        noise = NOISE * chance.standard_normal(everywhere.shape)
        deviation = pattern * torque / TORQUE + noise
        cell.learn(HuntingBlock(n, n, n + 1.0, 500.0, deviation, everywhere, 0.0, 1), torque)
    return cell


def test_noise_is_learned_as_no_slope_and_hides_no_tooth_at_another_load():
    at_its_load = np.sqrt(1.0 + 1.0 / BLOCKS)
    for seed in range(20):
        cell = learned(seed, np.zeros((CYCLES, BINS)), wander=0.3)
        assert cell.noise(np.array([TORQUE - 2.5])) < 1.05 * at_its_load


def test_the_slope_of_a_runout_is_learned():
    pattern = 2e-6 * np.random.default_rng(3).standard_normal((CYCLES, BINS))
    cell = learned(0, pattern, wander=1.5)
    assert np.vdot(cell.slope, pattern) / np.vdot(pattern, pattern) == pytest.approx(
        1.0 / TORQUE, rel=0.1
    )
    residual, _ = cell.residual(
        HuntingBlock(0, 0.0, 1.0, 500.0, 1.05 * pattern, cell.known, 0.0, 1), 1.05 * TORQUE
    )
    stated = NOISE * np.sqrt(cell.noise(np.array([1.05 * TORQUE])) ** 2 - 1.0)
    assert np.std(residual) == pytest.approx(stated, rel=0.15)
