"""Simulates the operating points of a measured table independently of each other.

The rows of a table are means of separate test runs: there is no manoeuvre from one operating point
to the next.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Mapping
from itertools import groupby

from ...model.clock import TICKS
from ...run.twin import Twin
from ...run.window import Window
from ...scene import TUNABLES
from .excerpt import Excerpt


def steady_points(
    excerpt: Excerpt, overrides: Mapping[str, float], most_samples: float
) -> Iterator[tuple[Window, float]]:
    """Simulate the intervals of a table with overrides in SI; yield windows and starts [s]."""
    tunable_values = {name: value for name, value in overrides.items() if name in TUNABLES}
    model_values = {name: value for name, value in overrides.items() if name not in TUNABLES}
    times = [change.time for change in excerpt.changes]
    scene = excerpt.scene.replace(**model_values)
    for change_index, intervals in groupby(
        excerpt.intervals, lambda interval: bisect_right(times, interval.begin / TICKS) - 1
    ):
        change = excerpt.changes[change_index]
        fixed = tunable_values if change.time >= excerpt.held_from else {}
        rows = list(intervals)
        length = (rows[0].end - rows[0].begin) / TICKS
        rate = min(rows[0].sample_rate, most_samples / length)
        twin = Twin(scene.replace(**(change.values | fixed)), rate, rows[0].tolerance)
        for _ in rows:
            yield twin.advance(length), rows[0].begin / TICKS
