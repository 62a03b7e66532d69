"""Reports whether the computed intervals can be trusted, and which dynamics were selected."""

from __future__ import annotations

import threading

from planetary_twin_py import DynamicsChoice, OperatingPoint, Window
from planetary_twin_py.checks.accuracy import course_warnings
from planetary_twin_py.checks.ledger import Balance, balance_of_window, ledger_warning
from planetary_twin_py.run.counters import Course
from planetary_twin_py.scene.unused import not_in_use

from ...base.diagnostics import Row, checked

ACCURACY = "simulation: accuracy"
LEDGER = "simulation: energy ledger"
DYNAMICS = "simulation: dynamics"
_COUNTERS = "unsettled", "reversals", "both_flanks", "unrepeated_flank_events"
_ENERGIES = "residual", "loss", "excess"


class IntervalReports:
    """
    Checks the intervals since the last reports as one run.

    The twin's thread adds intervals; the node's thread takes reports. `lasting` is a warning that
    applies to all intervals, until it is replaced.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self.lasting: str | None = None
        self._begin()

    def _begin(self) -> None:
        self._course, self._balance, self._loosest = Course(), Balance(), 0.0

    def add(self, window: Window) -> None:
        """Add an interval."""
        with self._lock:
            self._course = self._course.joined(window.course)
            self._balance = self._balance.joined(balance_of_window(window))
            self._loosest = max(self._loosest, window.tolerance)

    def rows(self) -> list[Row]:
        """Return the reports on ledger and accuracy of the intervals since the last call."""
        with self._lock:
            course, balance, loosest = self._course, self._balance, self._loosest
            self._begin()
        warnings = [self.lasting] if self.lasting else []
        warnings += course_warnings(course)
        return [
            checked(
                LEDGER,
                ledger_warning(balance, loosest),
                "closes",
                {name: f"{getattr(balance, name):.6g}" for name in _ENERGIES},
            ),
            checked(
                ACCURACY,
                "; also: ".join(warnings),
                "consistent with the tolerance",
                {name: f"{getattr(course, name):.6g}" for name in _COUNTERS},
            ),
        ]


def dynamics_row(choice: DynamicsChoice, point: OperatingPoint) -> Row:
    """
    Return the report on `choice` at the present operating `point`.

    It is a warning where the point is no longer the one at which errors were measured.
    """
    measured = choice.scene.operating_point
    differing = [name for name, value in measured if getattr(point, name) != value]
    changed = [name for name in differing if not_in_use(choice.scene, name) is None]
    fault = f"{', '.join(changed)} changed since; {choice.text}" if changed else None
    errors = {
        f"error.{each.dynamics}": each.refused or f"{each.error:.6g}" for each in choice.candidates
    }
    values = {"dynamics": choice.dynamics, "allowed_error": f"{choice.allowed:g}", **errors}
    return checked(DYNAMICS, fault, choice.text, values)
