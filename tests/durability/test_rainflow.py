"""Rainflow cycles against the example of ASTM E1049-85 and an independent count."""

import itertools

import numpy as np
import pytest

from planetary_twin_py.durability.rainflow import Rainflow

EXAMPLE = [-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0]  # ASTM E1049-85, figure 6


def counted(*parts):
    counter = Rainflow()
    for part in parts:
        counter.feed(part)
    return counter


def histogram(cycles):
    found = {}
    for r, n in zip(cycles.ranges, cycles.counts, strict=True):
        found[float(r)] = found.get(float(r), 0.0) + float(n)
    return found


def three_points(series):
    """ASTM E1049-85, section 5.4.4, word by word: ranges and their counts."""
    left, found = [], {}

    def count(a, b, n):
        found[abs(b - a)] = found.get(abs(b - a), 0.0) + n

    for value in series:
        left.append(value)
        while len(left) >= 3:
            x, y = abs(left[-1] - left[-2]), abs(left[-2] - left[-3])
            if x < y:
                break
            if len(left) == 3:
                count(left[0], left[1], 0.5)
                del left[0]
            else:
                count(left[-3], left[-2], 1.0)
                del left[-3:-1]
    for a, b in itertools.pairwise(left):
        count(a, b, 0.5)
    return found


def test_the_example_of_the_standard_has_its_counts():
    counter = counted(EXAMPLE)
    assert histogram(counter.cycles) == {3.0: 0.5, 4.0: 1.5, 6.0: 0.5, 8.0: 1.0, 9.0: 0.5}
    assert counter.residue == (-2.0, 1.0, -3.0, 5.0, -4.0, 4.0, -2.0)
    assert histogram(counter.repeated) == {3.0: 1.0, 4.0: 1.0, 7.0: 1.0, 9.0: 1.0}


def test_sums_of_powers_of_the_example():
    for cycles, sums in (
        (counted(EXAMPLE).cycles, (1094.0, 67_838.0, 2_848_969_501.0)),
        (counted(EXAMPLE).repeated, (1163.0, 77_123.0, 3_770_367_275.0)),
    ):
        for exponent, expected in zip((3, 5, 10), sums, strict=True):
            assert (cycles.counts * cycles.ranges**exponent).sum() == pytest.approx(expected)


@pytest.mark.parametrize("seed", range(20))
def test_counts_are_those_of_the_standard_for_any_history(seed):
    chance = np.random.default_rng(seed)
    turns = chance.integers(-9, 10, 200).astype(float)
    turns = turns[np.flatnonzero(np.diff(turns, prepend=99.0))]
    ups = np.diff(turns) > 0.0
    turns = [turns[0], *turns[1:-1][ups[1:] != ups[:-1]], turns[-1]]
    assert histogram(counted(turns).cycles) == three_points(turns)


@pytest.mark.parametrize("seed", range(5))
def test_a_history_may_be_cut_anywhere(seed):
    chance = np.random.default_rng(seed)
    history = np.repeat(chance.integers(-20, 21, 300).astype(float), chance.integers(1, 4, 300))
    cuts = np.sort(chance.integers(0, len(history), 40))
    whole, parts = counted(history), counted(*np.split(history, cuts))
    assert parts.residue == whole.residue
    for of_parts, of_whole in ((parts.cycles, whole.cycles), (parts.repeated, whole.repeated)):
        for found, expected in zip(of_parts, of_whole, strict=True):
            np.testing.assert_array_equal(found, expected)


def test_points_between_turning_points_count_nothing():
    fine = np.interp(np.linspace(0.0, 8.0, 801), np.arange(9.0), EXAMPLE)
    assert histogram(counted(fine).cycles) == pytest.approx(histogram(counted(EXAMPLE).cycles))


def test_a_constant_history_has_no_cycle():
    counter = counted([], [2.0], [2.0, 2.0])
    assert (len(counter.cycles.ranges), counter.residue) == (0, (2.0,))


def test_a_value_that_is_no_number_is_refused():
    counter = counted([1.0, 2.0])
    with pytest.raises(ValueError, match=r"^values\[1\] = nan: must be finite$"):
        counter.feed([3.0, float("nan")])
    assert counter.residue == (1.0, 2.0)
