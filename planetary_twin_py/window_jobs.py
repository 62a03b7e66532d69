"""Windows of runs as jobs for the core: one run alone, or many together in threads.

A window is computed in parts of at most 0.1 s, between which the run is checked and the
interpreter can be interrupted. `Run.window` yields each part as a job and is sent its outcome.
"""

from __future__ import annotations

from collections.abc import Generator, Sequence
from typing import NamedTuple

from ._core import Limits, March, Model, Report, WindowEnd, run_window, run_windows
from .integrators.clock import Instant, Sampling
from .integrators.interpolant import Waves
from .runaway import RunawayError


class WindowJob(NamedTuple):
    """A window, or a part of one; arguments of `_core.run_window`."""

    model: Model
    march: March
    until: Instant
    samples: Sampling
    limits: Limits
    report: Report
    first: int  # number of the first sample
    rate: float  # [Hz]
    out: Waves
    end: WindowEnd
    closes: bool  # whether the window ends there


WindowJobs = Generator[WindowJob, int, None]
"""Jobs of a window, each answered by its outcome."""


def run_alone(jobs: WindowJobs) -> None:
    """Compute the window of one run; its errors are raised."""
    job = next(jobs, None)
    while job is not None:
        try:
            job = jobs.send(run_window(*job))
        except StopIteration:
            return


def run_together(windows: Sequence[WindowJobs], workers: int) -> dict[int, RunawayError]:
    """Compute windows of many runs in so many threads.

    Returns the errors of those that failed, by place.
    """
    errors = dict[int, RunawayError]()
    pending = dict[int, WindowJob]()
    outcomes = dict[int, int | None].fromkeys(range(len(windows)))
    while outcomes:
        pending.clear()
        for place, outcome in outcomes.items():
            try:
                jobs = windows[place]
                pending[place] = next(jobs) if outcome is None else jobs.send(outcome)
            except StopIteration:
                pass
            except RunawayError as error:
                errors[place] = error
        found = run_windows(list(pending.values()), workers) if pending else []
        outcomes = dict(zip(pending, found, strict=True))
    return errors
