"""Parameters in, readings out: the recorded stretch, simulated with other parameters."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...recording.ros2.fields import POWER_FLOW
from ...scene import TUNABLES
from ...twin import LONGEST_WINDOW, TICKS, Twin
from ...window import Window
from .readings import Array, Interval, Readings, read, simulated
from .stretch import Stretch

UNSEEN = 1.0  # [Hz] sample rate of what nobody looks at
FEW = 100  # samples of an interval of which only the power flow, an integral, is looked at


@dataclass(frozen=True)
class Outcome:
    """What a simulation of the stretch gives."""

    readings: tuple[Readings, ...]
    contact_fraction: float
    """Share of time in contact, of the mesh where it is smallest."""


@dataclass(frozen=True)
class Model:
    """A stretch, what is free, and what is read."""

    stretch: Stretch
    free: tuple[str, ...]
    observables: tuple[str, ...]

    def __call__(self, values: Array) -> Outcome | None:
        """The readings with the free parameters at `values`; None where it cannot be simulated."""
        overrides = dict(zip(self.free, values.tolist(), strict=True))
        try:
            windows = list(_windows(self.stretch, overrides, self._most_samples))
        except (ValueError, ArithmeticError):
            return None
        intervals = [simulated(window, self.stretch.begins) for window in windows]
        contact = min(float(np.min(window.mesh["contact_fraction"])) for window in windows)
        return Outcome(read_all(self.observables, intervals, self.stretch), contact)

    @property
    def _most_samples(self) -> float:
        """Of an interval."""
        return FEW if set(self.observables) <= set(POWER_FLOW) else math.inf


def read_all(
    names: Sequence[str], intervals: Sequence[Interval], stretch: Stretch
) -> tuple[Readings, ...]:
    """Every observable over these intervals."""
    return tuple(read(name, intervals, stretch) for name in names)


def _windows(
    stretch: Stretch, overrides: Mapping[str, float], most_samples: float
) -> Iterator[Window]:
    """The intervals of a stretch, with parameters other than the recorded ones.

    What came before the operating point of the stretch is simulated as recorded: how it still moves
    at the start follows from the change.
    """
    first = (*stretch.before, *stretch.intervals)[0]
    held = {name: value for name, value in overrides.items() if name in TUNABLES}
    at_once = stretch.held_from == stretch.begins
    fixed = {name: value for name, value in overrides.items() if at_once or name not in held}
    twin = Twin(stretch.scene.replace(**fixed), UNSEEN, first.tolerance)
    begins = round(stretch.begins * TICKS)
    changes = deque(
        (
            round(change.time * TICKS) - begins,
            change.values | (held if change.time >= stretch.held_from else {}),
        )
        for change in stretch.changes
    )

    def reach(ticks: int) -> Window | None:
        """Run on to an instant after `begins`, through what changes on the way."""
        window = None
        while True:
            now = round(twin.time * TICKS)
            while changes and changes[0][0] <= now:
                twin.set(**changes.popleft()[1])
            if now >= ticks:
                return window
            stop = min(ticks, changes[0][0] if changes else ticks)
            window = twin.advance(min((stop - now) / TICKS, LONGEST_WINDOW))

    for interval in stretch.before:
        twin.set_tolerance(interval.tolerance)
        reach(interval.end - begins)
    for interval in stretch.intervals:
        reach(interval.begin - begins)
        twin.set_tolerance(interval.tolerance)
        length = (interval.end - interval.begin) / TICKS
        twin.set_sample_rate(min(interval.sample_rate, most_samples / length))
        window = reach(interval.end - begins)
        assert window is not None  # an interval has a length
        yield window
