"""The model to fit: simulates the recorded excerpt with other parameters."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce

import numpy as np

from ...model.clock import TICKS
from ...run.counters import Course
from ...run.twin import Twin
from ...run.window import Window
from ...run.window_plan import LONGEST_WINDOW
from ...scene import TUNABLES
from ...units.catalogue import TRAIN
from .excerpt import Excerpt
from .readings import Array, IntervalReadings, Readings, read, simulated
from .steady_points import steady_points

UNUSED = 1.0  # [Hz] sample rate if the samples are not used
FEW = 100  # samples per interval if only the power flow, an integral, is used


@dataclass(frozen=True)
class ModelOutput:
    """Readings of a simulation of the excerpt."""

    readings: tuple[Readings, ...]
    contact_fraction: float
    """Fraction of time in contact, smallest of any mesh."""
    course: Course
    """Counters of the intervals of the excerpt."""


@dataclass(frozen=True)
class Model:
    """An excerpt, the names of the free parameters, and the names of the observables."""

    excerpt: Excerpt
    free: tuple[str, ...]
    observables: tuple[str, ...]

    def __call__(self, values: Array) -> ModelOutput | None:
        """Readings with the free parameters at `values` (p,); None if the simulation fails."""
        overrides = dict(zip(self.free, values.tolist(), strict=True))
        try:
            intervals, windows = self._simulate(overrides)
        except (ValueError, ArithmeticError):
            return None
        contact = min(float(np.min(window.mesh["contact_fraction"])) for window in windows)
        course = reduce(Course.joined, (window.course for window in windows))
        return ModelOutput(read_all(self.observables, intervals, self.excerpt), contact, course)

    def _simulate(
        self, overrides: Mapping[str, float]
    ) -> tuple[list[IntervalReadings], list[Window]]:
        """Readings and window of every interval."""
        if self.excerpt.measured:
            parts = list(steady_points(self.excerpt, overrides, self._most_samples))
            return [simulated(w, begins) for w, begins in parts], [w for w, _ in parts]
        windows = list(_windows(self.excerpt, overrides, self._most_samples))
        return [simulated(window, self.excerpt.begins) for window in windows], windows

    @property
    def _most_samples(self) -> float:
        """Upper limit of samples per interval."""
        return FEW if set(self.observables) <= set(TRAIN) else math.inf


def read_all(
    names: Sequence[str], intervals: Sequence[IntervalReadings], excerpt: Excerpt
) -> tuple[Readings, ...]:
    """Readings of every observable over some intervals of an excerpt, recorded or simulated."""
    return tuple(read(name, intervals, excerpt) for name in names)


def _windows(
    excerpt: Excerpt, overrides: Mapping[str, float], most_samples: float
) -> Iterator[Window]:
    """Simulate the intervals of an excerpt with other parameters.

    The operating points before it are simulated as recorded, so that the transient after the last
    change is included.
    """
    first = (*excerpt.before, *excerpt.intervals)[0]
    tunable_values = {name: value for name, value in overrides.items() if name in TUNABLES}
    at_once = excerpt.held_from == excerpt.begins
    start_values = {
        name: value for name, value in overrides.items() if at_once or name not in tunable_values
    }
    twin = Twin(excerpt.scene.replace(**start_values), UNUSED, first.tolerance)
    begins = round(excerpt.begins * TICKS)
    changes = deque(
        (
            round(change.time * TICKS) - begins,
            change.values | (tunable_values if change.time >= excerpt.held_from else {}),
        )
        for change in excerpt.changes
    )

    def reach(ticks: int) -> Window | None:
        """Advance to `ticks` after `begins`, applying the changes at their times."""
        window = None
        while True:
            now = round(twin.time * TICKS)
            while changes and changes[0][0] <= now:
                twin.set(**changes.popleft()[1])
            if now >= ticks:
                return window
            stop = min(ticks, changes[0][0] if changes else ticks)
            window = twin.advance(min((stop - now) / TICKS, LONGEST_WINDOW))

    for interval in excerpt.before:
        twin.set_tolerance(interval.tolerance)
        reach(interval.end - begins)
    for interval in excerpt.intervals:
        reach(interval.begin - begins)
        twin.set_tolerance(interval.tolerance)
        length = (interval.end - interval.begin) / TICKS
        twin.set_sample_rate(min(interval.sample_rate, most_samples / length))
        window = reach(interval.end - begins)
        assert window is not None  # an interval is not empty
        yield window
