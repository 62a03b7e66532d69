"""Severities of faults over the time of a recording.

Those that are set are recorded, with those that have grown until then. Between two messages they
grow as in the run, from the recorded angles and forces: `run.growing`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...model.clock import TICKS
from ...model.gearbox import Gearbox
from ...model.pair_loads import cycles_of
from ...run.growing import PERIOD, Growing
from ...scene import Scene
from ...scene.growth import LawGrowth
from ..ros2.point import severities_of_point
from .series import Series

Array = NDArray[np.float64]
UNKNOWN = 0.5
"""Time without samples, in which a law may have made a fault grow unseen [s]."""
VISIBLE = 0.01
"""Relative change of a severity that begins a new stretch."""


class Recorded(NamedTuple):
    """Rows of a recording, or between its rows."""

    time: Array
    """Simulated time [s], (n,)."""
    stamp: NDArray[np.int64]
    """ROS time [ns], (n,)."""
    angle: Mapping[str, Array]
    """Angles of the members [rad] (n,), not modulo a turn."""
    force: Array
    """Forces of all meshes [N], (n, meshes)."""

    def cut(self, rows: slice) -> Recorded:
        """Some of the rows."""
        angle = {name: values[rows] for name, values in self.angle.items()}
        return Recorded(self.time[rows], self.stamp[rows], angle, self.force[rows])


class Stretch(NamedTuple):
    """Rows with the same severities."""

    begin: int
    end: int
    severities: Mapping[str, float]


def stretches(gearbox: Gearbox, points: Series, rows: Recorded) -> list[Stretch]:
    """Divide rows where severities change.

    Args:
        gearbox: of the recorded scene.
        points: messages of the operating point.
        rows: in the order of time, of one run or of several.

    Returns:
        Stretches that cover all rows.
    """
    if not gearbox.scene.severities or not len(rows.time):
        return [Stretch(0, len(rows.time), gearbox.scene.severities)]
    starts = [0, *(np.flatnonzero(np.diff(rows.time) < 0.0) + 1), len(rows.time)]
    found = list[Stretch]()
    for begin, end in pairwise(starts):
        marks = [*_of_run(gearbox, points, rows.cut(slice(begin, end)))]
        ends = [*(mark[0] for mark in marks[1:]), end - begin]
        found += [
            Stretch(begin + first, begin + last, values)
            for (first, values), last in zip(marks, ends, strict=True)
            if last > first
        ]
    return found


def grown_before(scene: Scene, points: Series, time: Array) -> str | None:
    """A remark if severities have grown by a law before what is drawn begins.

    A table of times or of passages says what they are then; a law goes on from what was set last.

    Args:
        scene: of the recording.
        points: messages of the operating point.
        time: of the rows [s], (n,).
    """
    begin = float(time[0]) if len(time) else 0.0
    laws = (n for n, one in enumerate(scene.faults) if isinstance(one.growing, LawGrowth))
    grown = [f"faults.{n}" for n in laws]
    known = float(max(points.time[points.time <= begin], default=0.0))
    if not grown or begin - known <= UNKNOWN:
        return None
    return (
        f"{', '.join(grown)}: how far it has grown from {known:g} s, when its severity was "
        f"recorded, to {begin:g} s, where the samples begin, is not known: it is drawn as if it "
        "began to grow there, with the loads of a smaller fault"
    )


def _of_run(
    gearbox: Gearbox, points: Series, rows: Recorded
) -> Iterator[tuple[int, dict[str, float]]]:
    """First row and severities of each stretch of a run."""
    growing, cycles = Growing(gearbox), cycles_of(gearbox, "sun", rows.angle)
    growing.begin(math.floor(float(rows.time[0]) * TICKS / PERIOD) * PERIOD, float(cycles[0]))
    # A row at the time of a change is the end of what was before it; a run begins with one.
    places = np.searchsorted(rows.stamp, points.stamp, side="right")
    places[points.stamp <= rows.stamp[0]] = 0
    sets = [
        (time, int(place), _known(growing.values, severities_of_point(text)))
        for time, place, text in zip(points.time, places, points["severities"], strict=True)
        if place < len(rows.time)
    ]
    drawn, reached = dict(growing.values), 0
    yield 0, drawn
    while sets or growing.grows:
        grows = growing.next / TICKS if growing.grows else math.inf
        is_set = bool(sets) and sets[0][0] <= grows
        at = sets[0][1] if is_set else max(int(np.searchsorted(rows.time, grows)), reached)
        if at >= len(rows.time):
            return
        part = rows.cut(slice(reached, at))
        growing.feed(part.angle, part.force)
        reached = at
        if is_set:
            growing.set(sets.pop(0)[2])
        else:
            growing.grow(float(np.interp(grows, rows.time, cycles)))
        if is_set or _differ(drawn, growing.values):
            drawn = dict(growing.values)
            yield at, drawn


def _known(present: Mapping[str, float], given: Mapping[str, float]) -> dict[str, float]:
    """Severities of faults that the scene has: it may be another than the recorded one."""
    return {name: value for name, value in given.items() if name in present}


def _differ(one: Mapping[str, float], other: Mapping[str, float]) -> bool:
    pairs = [(one[name], other[name]) for name in one]
    return any(abs(a - b) > VISIBLE * max(abs(a), abs(b)) for a, b in pairs)
