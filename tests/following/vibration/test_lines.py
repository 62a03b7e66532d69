"""Amplitudes of lines equal a direct Fourier sum over all samples."""

from fractions import Fraction

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.following.train import followed_train
from planetary_twin_py.following.vibration.lines import PatternAmplitudes

RATE = 20e3  # [Hz]
LOST = 0.0053  # 1 - (sin(0.125) / 0.125)^2 is 0.0052
TRAIN = followed_train(pt.load_scene("paper"))
CYCLES = abs(float(TRAIN.cycles))
TEETH = {"sun": 30, "planet": 20, "ring": 70}


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
    lines = [line for pattern in patterns for line in pattern.lines if line.mesh]
    values = 0.05 * rng.standard_normal(len(mesh))
    for line in lines:
        values += rng.uniform(0.1, 1.0) * np.cos(line.order * mesh + rng.uniform(0.0, 6.0))
    patterns, amplitudes, _ = found(angles, values)
    for pattern, amplitude in zip(patterns, amplitudes, strict=True):
        if not pattern.lines:
            continue
        power = 1 if pattern.name.startswith("modulation") else 2  # of an amplitude
        samples = values if power == 2 else (values - values.mean()) ** 2
        squares = [direct(mesh, samples, line.order) ** power for line in pattern.lines]
        expected = np.sqrt(np.mean(squares))
        assert amplitude == pytest.approx(expected, rel=LOST)


def test_lines_of_a_bearing_are_those_of_squared_samples():
    """A tone of 1 modulated by m has the line 2 m/2 = m at the modulation in its square."""
    angles = angle()
    mesh = angles * CYCLES
    amplitudes = PatternAmplitudes(TRAIN, (14, Fraction(1, 5)))
    (outer,) = (one for one in amplitudes.patterns if "outer" in one.name)
    (line,) = outer.lines
    assert line.order == pytest.approx(14 * 0.4 / TEETH["planet"])
    tone = np.cos(3.0 * mesh) * (1.0 + 0.2 * np.cos(line.order * mesh))
    lines, _ = amplitudes.of(angles, tone[:, None], np.inf)
    found = dict(zip((one.name for one in amplitudes.patterns), lines[0], strict=True))
    assert found[outer.name] == pytest.approx(np.sqrt(0.2), rel=0.01)


def test_indicators_are_those_of_their_definitions():
    """Rms and kurtosis of the samples without their mean."""
    angles, rng = angle(), np.random.default_rng(3)
    values = rng.standard_normal(len(angles)) + 3.0 * np.cos(CYCLES * angles) + 5.0
    patterns, lines, _ = found(angles, values)
    values -= values.mean()
    expected = {
        "rms": np.sqrt(np.mean(values**2)),
        "kurtosis": np.mean(values**4) / np.mean(values**2) ** 2,
    }
    indicators = {p.name: float(a) for p, a in zip(patterns, lines, strict=True) if not p.causes}
    assert indicators == pytest.approx(expected)
