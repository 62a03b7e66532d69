"""Intervals of a run are kept in columns, and read as they were added."""

import tracemalloc

from planetary_twin_py.recording.runs.intervals import Interval, Intervals

NOW = 1_790_000_000_000_000_000  # [ns]


def interval(n):
    return Interval(n, NOW + n, n * 2**40, (n + 1) * 2**40, 1e-4 / (n + 1), 5e4, n % 3 > 0)


def test_intervals_are_those_that_were_added():
    expected = [interval(n) for n in range(50)]
    found = Intervals(expected[:40])
    for each in expected[40:]:
        found.append(each)
    assert list(found) == expected and len(found) == 50
    assert (found[0], found[-1]) == (expected[0], expected[-1])
    assert found[10:20] == expected[10:20] and isinstance(found[1].recorded, bool)
    assert not Intervals()


def test_an_interval_takes_some_tens_of_bytes():
    count = 20_000
    tracemalloc.start()
    kept = Intervals(map(interval, range(count)))
    taken, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert len(kept) == count and taken < 80 * count


def test_intervals_that_are_cut_off_keep_their_values():
    expected = [interval(n) for n in range(50)]
    first = Intervals(expected)
    rest = first.cut(30)
    assert (list(first), list(rest)) == (expected[:30], expected[30:])
    whole = first.cut(0)
    assert not first and list(whole) == expected[:30]
    assert list(whole.stamps) == [each.stamp for each in expected[:30]]
