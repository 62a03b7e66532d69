"""Intervals of a run are kept in columns, and read as they were added."""

import tracemalloc

import pytest

from planetary_twin_py.model.clock import TICKS
from planetary_twin_py.recording.runs.commands_by_stamp import CommandsByStamp
from planetary_twin_py.recording.runs.intervals import Interval, Intervals, in_ticks

NOW = 1_790_000_000_000_000_000  # [ns]


def interval(n):
    return Interval(n, NOW + n, n * 2**40, (n + 1) * 2**40, 1e-4 / (n // 3 + 1), 5e4, n % 4 > 0)


def following(n):
    """An interval that continues the one before."""
    return Interval(n, NOW + 3 * n, n * 10**10 + n % 2, (n + 1) * 10**10 + (n + 1) % 2, 1e-4, 5e4)


def taken_by(make):
    """What `make` returns, and the memory that it takes [bytes]."""
    tracemalloc.start()
    made = make()
    taken, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return made, taken


def test_an_interval_takes_some_bytes():
    count = 20_000
    Intervals(map(following, range(count)))  # what is allocated once
    kept, taken = taken_by(lambda: Intervals(map(following, range(count))))
    assert len(kept) == count and taken < 20 * count
    assert kept[17:19] == [following(17), following(18)]


def test_commands_are_those_that_were_added_in_some_bytes():
    def commands():
        kept = CommandsByStamp()
        for n in [*range(1, count), 0]:
            kept.add(
                NOW + n, {"input_torque": float(n)} | ({"output_speed": 1.0} if n == 7 else {})
            )
        kept.add(NOW + 9, {"input_torque": 0.5})
        return kept

    count = 20_000
    kept, taken = taken_by(commands)
    assert len(kept) == count and taken < 40 * count
    assert list(kept) == [NOW + n for n in range(count)] and NOW + count not in kept
    assert kept[NOW] == {"input_torque": 0.0} and kept[NOW + 9] == {"input_torque": 0.5}
    assert kept[NOW + 7] == {"input_torque": 7.0, "output_speed": 1.0}


@pytest.mark.parametrize("length", [10**10, 16_666_666_667, 2_500_000_000])
@pytest.mark.parametrize("hours", [0, 3, 24, 200])
def test_rounded_times_give_exact_ticks(hours, length):
    """Of intervals without a gap, of which some are missing, and of a shorter one after them."""
    first = hours * 3600 * TICKS // length
    begins = [(number, number * length) for number in range(first, first + 500)]
    before = begins[0][0], begins[0][1], begins[0][1] + length
    before = Interval(before[0], 0, before[1], before[2], 1e-4, 5e4)
    shorter = (begins[-1][0] + 1, begins[-1][1] + length, length // 10**6 * 10**5)
    kept = [(n, b, length) for n, b in begins[1:] if n % 7 or b == begins[-1][1]]
    for number, begin, ticks in [*kept, shorter]:
        end = (begin + ticks) / TICKS
        found = in_ticks(number, end, end - begin / TICKS, before)
        assert found == (begin, begin + ticks)
        before = Interval(number, 0, *found, 1e-4, 5e4)
