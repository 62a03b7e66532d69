"""Windows of runs as jobs for the core: one run alone, or many together in threads.

A window is computed in parts of at most 0.1 s, between which the run is checked and the
interpreter can be interrupted. `Run.window` yields each part as a job, and receives its outcome.
"""

from __future__ import annotations

import sys
from collections.abc import Generator, Sequence
from contextlib import suppress
from types import ModuleType
from typing import NamedTuple

from .._core import Integrator, Limits, Model, Report, WindowEnd
from ..model.clock import Instant, Sampling, sampling
from .limits import RunawayError
from .samples import Waves


class Grid(NamedTuple):
    """Samples at equal intervals; as the core takes them."""

    begin: Sampling
    first: int  # number of the first sample
    rate: float  # [Hz]
    out: Waves


def grid(first: int, rate: float, out: Waves) -> Grid:
    """Samples from number `first` on at multiples of 1/rate [s]."""
    return Grid(sampling(first, rate), first, rate, out)


class WindowJob(NamedTuple):
    """A window, or a part of one; as `_core.run_window` takes it."""

    model: Model
    integrator: Integrator
    until: Instant
    limits: Limits
    report: Report
    grids: tuple[Grid, ...]  # independent of one another; the limits apply to the first
    end: WindowEnd
    closes: bool  # whether the window ends there


WindowJobs = Generator[WindowJob, int, None]
"""Yields the jobs of a window, and receives the outcome of each."""


def _core_of(job: WindowJob) -> ModuleType:
    """The build of the core that has made the records of a job."""
    return sys.modules[type(job.model).__module__]


def run_alone(jobs: WindowJobs) -> None:
    """Compute the window of one run; its errors are raised."""
    job = next(jobs, None)
    while job is not None:
        try:
            outcome = _core_of(job).run_window(job)
        except KeyboardInterrupt as interrupt:
            jobs.throw(interrupt)
        try:
            job = jobs.send(outcome)
        except StopIteration:
            return


def run_together(windows: Sequence[WindowJobs], workers: int) -> dict[int, RunawayError]:
    """Compute the windows of many runs in `workers` threads.

    Returns the errors of the runs that failed, by index.
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
        outcomes = {}
        for core in dict.fromkeys(map(_core_of, pending.values())):
            own = {place: job for place, job in pending.items() if _core_of(job) is core}
            try:
                found = core.run_windows(list(own.values()), workers) if own else []
            except KeyboardInterrupt as interrupt:
                for place in pending:
                    with suppress(KeyboardInterrupt):
                        windows[place].throw(interrupt)
                raise
            outcomes |= zip(own, found, strict=True)
    return errors
