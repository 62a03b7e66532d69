"""False alarms of a growth of vibration are as rare as stated."""

import numpy as np

from planetary_twin_py.following.vibration import growth as vibration_growth
from planetary_twin_py.following.vibration.growth import (
    WINDOWS,
    JudgedPeriod,
    LearnedBaseline,
    VibrationGrowth,
)
from planetary_twin_py.following.vibration.patterns import Line, Pattern

PATTERNS = [Pattern(str(n), (Line(1, 0.0),), ("a cause",)) for n in range(6)]
LEARNING, AFTER, GEARBOXES = 24, 64, 150


def alarms(lines):
    """False alarms of gearboxes with these numbers of lines in noise, each of a second."""
    chance = np.random.default_rng(5)
    count = 0
    for _ in range(GEARBOXES):
        growth = VibrationGrowth(("x", "y"), PATTERNS, LEARNING)
        cell = LearnedBaseline(1.0, 1.0, 4.0)
        quiet = np.full((2, len(PATTERNS)), np.nan)
        for n in range(LEARNING + AFTER):
            waves = chance.standard_normal((2, len(PATTERNS), lines, 2))
            found = np.sqrt(np.mean(np.sum(waves**2, axis=-1), axis=-1))
            growth.add(JudgedPeriod(float(n), found, quiet, 1.0, 1.0), cell, n + 1.0)
        count += len(growth.events)
    return count


def test_false_alarms_are_rarer_than_stated(monkeypatch):
    """One in 100 s is asked for, instead of in a year, so that some are seen."""
    monkeypatch.setattr(vibration_growth, "YEAR", 100.0)
    stated = GEARBOXES * AFTER / 100.0
    assert 0.05 * stated < alarms(12) < stated


def test_the_limit_of_a_year_is_that_of_its_tests():
    growth = VibrationGrowth(("x",), PATTERNS, 10_000)
    # 6 patterns in 2 windows each second: a normal deviate of 1 in 3.8e8 is 5.838
    assert len(WINDOWS) == 2 and abs(growth._limit(1.0) - 5.838) < 0.01
