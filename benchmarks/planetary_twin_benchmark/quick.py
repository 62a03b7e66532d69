"""The table of the README in two minutes: speed, error, and how many times faster than CVODE."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from importlib.util import find_spec
from typing import Any, NamedTuple

import numpy as np

from planetary_twin_py._core import DTE, POWER_LOSS
from planetary_twin_py.scene import Scene

from . import timing
from .cases import CASES, PLANAR_CASES, Case
from .peers import solvers
from .peers.solver import SolverError
from .peers.work_precision import LIMIT, UNSAMPLED
from .reference import converged
from .steady import NOT, Steady, measure_steady
from .table import Row, dte_error, loss_error
from .timing import METHOD, SAMPLE_RATE, Speed

TOLERANCE = 1e-3  # of the speeds; the ratio is at equal error
# Error of the DTE at which the integrator is compared with CVODE.
COMPARED_AT = {
    "steady 1000 rpm": 1e-4,
    "rattle": 1e-4,
    "light damping 1000 rpm": 1e-4,
    "resonance 17 000 rpm": 1e-3,
    "planar, floating sun": 1e-4,
    "spatial": 1e-4,
}
QUICK_CASES = tuple(case for case in (*CASES, *PLANAR_CASES) if case.name in COMPARED_AT)
TOLERANCES = tuple(10.0 ** (-k / 4) for k in range(8, 33))  # tried until the error is reached
PEERS = ("cvode_bdf_compiled", "cvode_adams_compiled")
ROUNDS = 7


class Solver(NamedTuple):
    """A method at a tolerance."""

    method: str
    tolerance: float

    def run(self, case: Case, duration: float, *, sampled: bool) -> solvers.Run:
        """Solve the scene of a case from its start."""
        return self._run(case.scene(), duration, sampled)

    def compared(self, case: Case) -> solvers.Run:
        """Solve the interval that is compared with the reference."""
        return self._run(case.compared(), case.duration, sampled=True)

    def _run(self, scene: Scene, duration: float, sampled: bool) -> solvers.Run:
        if self.method != METHOD:
            rate = SAMPLE_RATE if sampled else UNSAMPLED
            return solvers.run(self.method, scene, duration, rate, self.tolerance, LIMIT)
        found = timing.run(scene, duration, METHOD, self.tolerance, sampled=sampled)
        if not sampled:
            return solvers.Run(found.mesh, 0.0, found.seconds, found.setup_s)
        loss = float(found.mesh[:, POWER_LOSS].sum(axis=1).mean())
        return solvers.Run(found.mesh[:, DTE], loss, found.seconds, found.setup_s)


class _Entry(NamedTuple):
    """A solver, and its errors and cost in the compared interval."""

    solver: Solver
    errors: tuple[float, float]  # of the DTE and of the power loss
    seconds: float
    setup_s: float


class Quick(NamedTuple):
    """A line of the table."""

    rows: list[Row]  # the integrator at TOLERANCE; then, at the compared error, it and CVODE
    ratio: Speed  # there to the faster CVODE, or NaN
    sampled_ratio: Speed  # the same with samples
    minute: Steady

    def figures(self) -> Iterator[dict[str, Any]]:
        """Values for JSON, the ratios at the row of the integrator with the compared error."""
        for n, row in enumerate(self.rows):
            ratios = {"times_cvode": self.ratio, "times_cvode_sampled": self.sampled_ratio}
            yield row.figures() | (ratios if n == 1 else {})
        yield self.minute.figures()


def peers_installed() -> bool:
    """Whether CVODE is there to be compared with."""
    return find_spec("sksundae") is not None


class _Contest(NamedTuple):
    """A case and the solvers that are timed over its same interval: first at TOLERANCE, then, at
    the compared error, the integrator and its peers.
    """

    case: Case
    entries: list[_Entry]
    span: float  # [s]

    def round(self) -> list[list[float]]:
        """Speeds of all solvers, without and with samples."""
        return [
            [
                self.span / entry.solver.run(self.case, self.span, sampled=sampled).seconds
                for entry in self.entries
            ]
            for sampled in (False, True)
        ]

    def judge(self, speeds: np.ndarray) -> tuple[list[Row], Speed, Speed]:
        """Rows of all solvers and ratios, from the speeds of all rounds."""
        rows = [
            Row(
                self.case.name, *entry.solver, *entry.errors,
                *Speed.of(bare), Speed.of(sampled).median, entry.setup_s,
            )
            for entry, (bare, sampled) in zip(self.entries, speeds.transpose(2, 1, 0), strict=True)
        ]  # fmt: skip
        if len(self.entries) == 1:
            return rows, NOT, NOT
        ratios = speeds[:, :, 1] / speeds[:, :, 2:].max(axis=2)
        return rows, Speed.of(ratios[:, 0]), Speed.of(ratios[:, 1])


def measure_quick(
    cases: Iterable[Case], progress: Callable[[str], None] = lambda text: None
) -> list[Quick]:
    """Measure all cases; without ratios if CVODE is missing or, with moving axes, no equations.

    All cases take turns, so a machine that is slower for seconds does not slow one of them alone.
    """
    contests = []
    for case in cases:
        progress(f"{case.name}: reference")
        contests.append(_contest(case))
    rounds = []
    for number in range(ROUNDS):
        progress(f"round {number + 1} of {ROUNDS}")
        rounds.append([contest.round() for contest in contests])
    return [
        Quick(
            *contest.judge(np.array(speeds)), *measure_steady([contest.case], [TOLERANCE], progress)
        )
        for contest, *speeds in zip(contests, *rounds, strict=True)
    ]


def _contest(case: Case) -> _Contest:
    """The solvers of a case, over an interval that the slowest computes in the time of a round."""
    reference = converged(case.compared(), case.duration, SAMPLE_RATE)
    entries = [_entry(Solver(METHOD, TOLERANCE), case, reference)]
    if peers_installed() and not case.scene().moving_axes:
        entries += [_loosest(method, case, reference) for method in (METHOD, *PEERS)]
    return _Contest(case, entries, case.timed(max(entry.seconds for entry in entries)))


def _loosest(method: str, case: Case, reference: np.ndarray) -> _Entry:
    """The method at the first of TOLERANCES with which it reaches the compared error."""
    for tolerance in TOLERANCES:
        try:
            entry = _entry(Solver(method, tolerance), case, reference)
        except SolverError:  # it gives up, as some do at loose tolerances
            continue
        if entry.errors[0] <= COMPARED_AT[case.name]:
            return entry
    raise RuntimeError(f"{case.name}: {method} does not reach {COMPARED_AT[case.name]:g}")


def _entry(solver: Solver, case: Case, reference: np.ndarray) -> _Entry:
    found = solver.compared(case)
    lost, true = found.power_loss * len(reference), reference[:, POWER_LOSS].sum()
    errors = dte_error(found.dte, reference[:, DTE]), loss_error(lost, true)
    return _Entry(solver, errors, found.seconds, found.setup_s)
