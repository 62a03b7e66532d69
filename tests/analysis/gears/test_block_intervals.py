"""Intervals of figures of an average: how often they contain the value of many turns."""

import numpy as np
import pytest

from planetary_twin_py.analysis.gears.block_intervals import blocks_of, bootstrap, jackknife
from planetary_twin_py.analysis.gears.indicators import condition_indicators


def test_the_interval_of_a_mean_is_that_of_student():
    """Of one point and one turn a block: mean -+ t_(0.975, 11) s/sqrt(12), t = 2.200985."""
    turns = np.random.default_rng(1).normal(size=(12, 1))
    found = jackknife(turns, lambda average: {"mean": float(average[0])})["mean"]
    reach = 2.200985 * turns.std(ddof=1) / np.sqrt(12.0)
    assert found.value == pytest.approx(turns.mean())
    assert found.high - found.value == pytest.approx(reach, rel=1e-6)
    assert found.value - found.low == pytest.approx(reach, rel=1e-6)


TEETH, POINTS = 12, 96


def indicators(average):
    found = condition_indicators(average, TEETH)
    return {name: getattr(found, name) for name in ("peak", "fm0", "crest_factor")}


@pytest.mark.parametrize("burst", [0.0, 0.5])
def test_intervals_of_maxima_are_as_wide_as_they_scatter(burst):
    """Of other records; Student's t with 11 degrees of freedom is 1.12 times that of many."""
    random, turns, sigma = np.random.default_rng(4), 12, 0.3
    angle = 2.0 * np.pi * np.arange(POINTS) / POINTS
    wave = np.cos(TEETH * angle) * (1.0 + 0.1 * np.cos(angle))
    wave += burst * np.exp(-0.5 * ((angle - 3.0) / 0.1) ** 2) * np.cos(1.5 * TEETH * angle)
    scatter = sigma / np.sqrt(turns)
    others = [indicators(wave + scatter * random.normal(size=POINTS)) for _ in range(400)]
    found = [
        bootstrap(wave + sigma * random.normal(size=(turns, POINTS)), indicators) for _ in range(12)
    ]
    for name in others[0]:
        usual = 2.0 * 1.96 * np.std([other[name] for other in others])
        width = np.mean([one[name].high - one[name].low for one in found])
        assert 0.95 < width / usual < 1.4, name


def test_95_of_100_intervals_contain_the_rms():
    """An average of a cosine in weak noise: its rms is 1/sqrt 2 and a share of the noise."""
    random, points, turns, sigma = np.random.default_rng(2), 64, 40, 0.3
    wave = np.cos(2.0 * np.pi * np.arange(points) / points)
    expected = np.sqrt(0.5 + sigma**2 / turns)
    inside = 0
    for _ in range(400):
        record = wave + sigma * random.normal(size=(turns, points))
        found = jackknife(record, lambda one: {"rms": float(np.sqrt(np.mean(one**2)))})["rms"]
        inside += found.low < expected < found.high
    # Standard deviation of the count: sqrt(400 x 0.95 x 0.05) = 4.4.
    assert 365 < inside < 395


@pytest.mark.parametrize(
    ("turns", "blocks"), [(6, 6), (7, 7), (20, 20), (26, 13), (39, 13), (41, 20)]
)
def test_blocks_leave_out_no_turn_where_possible(turns, blocks):
    assert blocks_of(turns) == blocks


def test_few_turns_have_no_interval():
    with pytest.raises(ValueError, match="turns: 5: must be at least 6"):
        jackknife(np.ones((5, 8)), lambda one: {"mean": 1.0})
