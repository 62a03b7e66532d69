"""Amplitudes of lines equal a direct Fourier sum over all samples."""

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.following.train import followed_train
from planetary_twin_py.following.vibration_lines import PatternAmplitudes

RATE = 20e3  # [Hz]
LOST = 0.0053  # 1 - (sin(0.125) / 0.125)^2 is 0.0052
TRAIN = followed_train(pt.load_scene("paper"))
CYCLES = abs(float(TRAIN.cycles))


def angle(sign=1.0):
    """Angle of the input at the samples of one hunting period [rad]."""
    turned = 2.0 * np.pi * TRAIN.hunting_cycles / CYCLES
    return sign * np.arange(0.0, turned, TRAIN.speed / RATE)


def direct(mesh, values, order):
    """Amplitude at a mesh order by a Fourier sum over a Hann window."""
    window = np.hanning(len(mesh) + 2)[1:-1]
    wave = np.exp(-1j * order * mesh) * window
    return 2.0 * abs(np.sum(wave * (values - values.mean()))) / window.sum()


def found(angles, values):
    amplitudes = PatternAmplitudes(TRAIN)
    lines, beside = amplitudes.of(angles, values[:, None], np.inf)
    return amplitudes.patterns, lines[0], beside[0]


@pytest.mark.parametrize("sign", [1.0, -1.0], ids=["forwards", "backwards"])
def test_amplitudes_of_patterns_are_those_of_a_fourier_sum(sign):
    angles = angle(sign)
    mesh, rng = angles * CYCLES, np.random.default_rng(7)
    patterns = PatternAmplitudes(TRAIN).patterns
    lines = [line for pattern in patterns for line in pattern.lines]
    values = 0.05 * rng.standard_normal(len(mesh))
    for line in lines:
        values += rng.uniform(0.1, 1.0) * np.cos(line.order * mesh + rng.uniform(0.0, 6.0))
    patterns, amplitudes, _ = found(angles, values)
    for pattern, amplitude in zip(patterns, amplitudes, strict=True):
        squares = [direct(mesh, values, line.order) ** 2 for line in pattern.lines]
        expected = np.sqrt(np.mean(squares))
        assert amplitude == pytest.approx(expected, rel=LOST)
