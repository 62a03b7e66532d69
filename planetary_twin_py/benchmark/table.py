"""Runs every case at every tolerance, and says how fast and how wrong."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable
from typing import NamedTuple

import numpy as np

from ..dynamics.observe import DTE, POWER_LOSS
from ..engine import Engine
from .cases import Case
from .reference import Reference

SAMPLE_RATE = 50_000.0
TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5)
METHOD = "auto"
ROUNDS = 3  # timed runs, of which the median counts


class Row(NamedTuple):
    """One run of one case."""

    case: str
    method: str
    tolerance: float
    error_dte: float  # rms error of the transmission error over its rms, the worst mesh [-]
    error_power_loss: float  # error of the mean power loss over its value [-]
    rtf: float  # simulated over processor time, median
    rtf_low: float  # the slowest round
    rtf_high: float  # the fastest
    setup_s: float  # building and starting the model, kernels compiled [s]
    note: str = ""  # why there are no figures (they are NaN)

    def figures(self) -> dict[str, str | float | None]:
        """For JSON, which knows no NaN."""
        values = self._asdict()
        return {name: None if value != value else value for name, value in values.items()}


# Further rows of a case, held against its reference (samples, QUANTITIES, meshes).
Beside = Callable[[Case, np.ndarray], Iterable[Row]]


def nothing(case: Case, reference: np.ndarray) -> Iterable[Row]:
    """No further rows."""
    return ()


def measure(
    cases: Iterable[Case],
    tolerances: Iterable[float] = TOLERANCES,
    progress: Callable[[str], None] = lambda text: None,
    beside: Beside = nothing,
) -> list[Row]:
    """Measure all cases.

    Args:
        cases: what to measure.
        tolerances: each gives a row.
        progress: is told what is under way.
        beside: gives further rows.
    """
    rows = []
    for case in cases:
        progress(f"{case.name}: reference")
        reference = Reference(case.scene()).run(case.duration, SAMPLE_RATE)
        for tolerance in tolerances:
            progress(f"{case.name}: tolerance {tolerance:g}")
            rows.append(_row(case, tolerance, reference))
        rows += beside(case, reference)
    return rows


def _row(case: Case, tolerance: float, reference: np.ndarray) -> Row:
    samples = _run(case, tolerance, case.duration)[0]
    rounds, setup = [], 0.0
    for _ in range(ROUNDS):
        _, seconds, setup = _run(case, tolerance, case.duration * case.repeats)
        rounds.append(case.duration * case.repeats / seconds)
    return Row(
        case.name, METHOD, tolerance,
        *errors(samples, reference),
        float(np.median(rounds)), min(rounds), max(rounds), setup,
    )  # fmt: skip


def _run(case: Case, tolerance: float, duration: float) -> tuple[np.ndarray, float, float]:
    """Samples, processor time of the run [s], wall time of the set-up [s]."""
    begin = time.perf_counter()
    engine = Engine(case.scene(), tolerance)
    setup = time.perf_counter() - begin
    begin = time.process_time()
    samples = engine.advance(duration, 1, SAMPLE_RATE, round(duration * SAMPLE_RATE))
    return samples.mesh, time.process_time() - begin, setup


def errors(samples: np.ndarray, reference: np.ndarray) -> tuple[float, float]:
    """Relative errors of the transmission error and of the mean power loss."""
    lost, true = samples[:, POWER_LOSS].sum(), reference[:, POWER_LOSS].sum()
    return dte_error(samples[:, DTE], reference[:, DTE]), loss_error(lost, true)


def dte_error(dte: np.ndarray, true: np.ndarray) -> float:
    """Relative error (rms, worst mesh) of transmission errors (samples, meshes)."""
    return float(np.sqrt(((dte - true) ** 2).mean(axis=0) / (true**2).mean(axis=0)).max())


def loss_error(lost: float, true: float) -> float:
    """Relative error of a power loss; NaN where nothing is lost."""
    return float(abs(lost / true - 1.0)) if true else math.nan
