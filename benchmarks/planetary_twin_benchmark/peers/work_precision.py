"""Speed and error of every peer in a case."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator

import numpy as np

from planetary_twin_py._core import DTE, POWER_LOSS
from planetary_twin_py.scene import Scene

from ..cases import Case
from ..table import TOLERANCES, Beside, Row, dte_error, loss_error
from ..timing import ROUNDS, SAMPLE_RATE, Speed
from .solver import SolverError, TooSlow
from .solvers import SOLVERS, Run, run

LIMIT = 15.0  # [s] for one of the runs of a row
UNSAMPLED = 1000.0  # [Hz] of a run without samples: often enough to end it at its limit


def peer_rows(
    progress: Callable[[str], None] = lambda text: None,
    tolerances: Iterable[float] = TOLERANCES,
    names: Iterable[str] = tuple(SOLVERS),
) -> Beside:
    """Function that returns rows of the peers `names`; `progress` receives what is measured."""
    tolerances, names = sorted(tolerances, reverse=True), list(names)

    def rows(case: Case, reference: np.ndarray) -> Iterator[Row]:
        for name in names:
            progress(f"{case.name}: {name}")
            yield from _rows(case, name, tolerances, reference)

    return rows


def _rows(case: Case, name: str, tolerances: list[float], reference: np.ndarray) -> Iterator[Row]:
    """A row for every tolerance; after one that takes too long, smaller ones are not run."""
    slow: SolverError | None = None
    for tolerance in tolerances:
        try:
            if slow is not None:
                raise slow
            yield _row(case, name, tolerance, reference)
        except SolverError as error:
            slow = error if isinstance(error, TooSlow) else None
            nan = math.nan
            yield Row(
                case.name, name, tolerance, nan, nan, nan, nan, nan, nan, nan, note=str(error)
            )


def _row(case: Case, name: str, tolerance: float, reference: np.ndarray) -> Row:
    first = _run(case.compared(), case.duration, name, tolerance, SAMPLE_RATE)
    timed = case.timed(first.seconds)

    def speed(sample_rate: float) -> Speed:
        runs = [_run(case.scene(), timed, name, tolerance, sample_rate) for _ in range(ROUNDS)]
        return Speed.of([timed / each.seconds for each in runs])

    return Row(
        case.name, name, tolerance,
        dte_error(first.dte, reference[:, DTE]),
        loss_error(first.power_loss * len(reference), reference[:, POWER_LOSS].sum()),
        *speed(UNSAMPLED), speed(SAMPLE_RATE).median, first.setup_s,
    )  # fmt: skip


def _run(scene: Scene, duration: float, name: str, tolerance: float, sample_rate: float) -> Run:
    return run(name, scene, duration, sample_rate, tolerance, LIMIT)
