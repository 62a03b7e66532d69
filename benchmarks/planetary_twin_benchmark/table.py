"""Runs every case at every tolerance and measures speed and error."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import NamedTuple

import numpy as np

from planetary_twin_py._core import DTE, POWER_LOSS

from .cases import Case
from .reference import Reference
from .timing import METHOD, SAMPLE_RATE, end_to_end, run, speed

TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
METHODS = (METHOD, "rosenbrock")
WHOLE = 1.0  # [s] simulated from the scene to the result, set-up included


class Row(NamedTuple):
    """One run of one case."""

    case: str
    method: str
    tolerance: float
    error_dte: float  # rms error of the transmission error over its rms, largest of all meshes [-]
    error_power_loss: float  # error of the mean power loss over its value [-]
    rtf: float  # simulated over processor time without samples, median
    rtf_low: float  # the slowest round
    rtf_high: float  # the fastest
    rtf_sampled: float  # with samples of all meshes, median
    setup_s: float  # building and starting the model [s]
    end_to_end_rtf: float = math.nan  # of WHOLE seconds over wall time, set-up and samples included
    note: str = ""  # why there are no figures (they are NaN)

    @property
    def error_ratio(self) -> float:
        """Error of the transmission error over the tolerance."""
        return self.error_dte / self.tolerance

    def figures(self) -> dict[str, str | float | None]:
        """Values for JSON, None for NaN."""
        values = self._asdict()
        return {name: None if value != value else value for name, value in values.items()}


# Further rows of a case, compared with its reference (samples, QUANTITIES, meshes).
Beside = Callable[[Case, np.ndarray], Iterable[Row]]


def nothing(case: Case, reference: np.ndarray) -> Iterable[Row]:
    """No further rows."""
    return ()


def measure(
    cases: Iterable[Case],
    tolerances: Iterable[float] = TOLERANCES,
    progress: Callable[[str], None] = lambda text: None,
    beside: Beside = nothing,
    methods: Iterable[str] = METHODS,
) -> list[Row]:
    """Measure all cases.

    Args:
        cases: to measure.
        tolerances: a row of every method for each.
        progress: receives the name of what is being measured.
        beside: gives further rows.
        methods: of `Engine`.
    """
    tolerances, methods, rows = list(tolerances), list(methods), []
    for case in cases:
        progress(f"{case.name}: reference")
        reference = Reference(case.compared()).run(case.duration, SAMPLE_RATE)
        for method in methods:
            for tolerance in tolerances:
                progress(f"{case.name}: {method}, tolerance {tolerance:g}")
                rows.append(_row(case, method, tolerance, reference))
        rows += beside(case, reference)
    return rows


def _row(case: Case, method: str, tolerance: float, reference: np.ndarray) -> Row:
    scene = case.scene()
    first = run(case.compared(), case.duration, method, tolerance, sampled=True)
    timed = case.timed(first.seconds)
    bare, sampled = (
        speed(scene, timed, method, tolerance, sampled=sampled) for sampled in (False, True)
    )
    whole = end_to_end(scene, WHOLE, tolerance).median if method == METHOD else math.nan
    return Row(
        case.name, method, tolerance,
        *errors(first.mesh, reference),
        *bare, sampled.median, first.setup_s, whole,
    )  # fmt: skip


def errors(samples: np.ndarray, reference: np.ndarray) -> tuple[float, float]:
    """Relative errors of the transmission error and of the mean power loss."""
    lost, true = samples[:, POWER_LOSS].sum(), reference[:, POWER_LOSS].sum()
    return dte_error(samples[:, DTE], reference[:, DTE]), loss_error(lost, true)


def dte_error(dte: np.ndarray, true: np.ndarray) -> float:
    """Relative rms error, largest of all meshes, of transmission errors (samples, meshes)."""
    return float(np.sqrt(((dte - true) ** 2).mean(axis=0) / (true**2).mean(axis=0)).max())


def loss_error(lost: float, true: float) -> float:
    """Relative error of a power loss; NaN if there is no loss."""
    return float(abs(lost / true - 1.0)) if true else math.nan
