"""Whether the energy ledger of a run closes well enough to believe its losses.

Integration is the only reason for which energy in is not energy out, stored or lost. The residual
is as uncertain a part of the losses, so it is judged by them: 1 % of the loss, or 1e-5 of what is
turned over where hardly anything is lost.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from .result import Energy
from .tolerance import TOLERANCES
from .window import Window

OF_LOSS = 0.01  # largest residual
OF_TURNOVER = 1e-5  # the same of a train that hardly loses anything
OF_STORED = 1e-9  # what the rounding of masses and springs leaves, where nothing is turned over


class LedgerWarning(UserWarning):
    """The energy ledger of a run does not close."""


class Balance(NamedTuple):
    """What the ledger of a run, or of a part of it, is judged by [J]."""

    residual: float = 0.0
    loss: float = 0.0
    turnover: float = 0.0
    """What passes the machines, and by how much the stored energy changes."""
    stored: float = 0.0
    """In masses and springs."""

    @property
    def excess(self) -> float:
        """Magnitude of the residual over what is allowed; the ledger closes up to 1."""
        allowed = max(
            OF_LOSS * abs(self.loss), OF_TURNOVER * self.turnover, OF_STORED * self.stored
        )
        if self.residual == 0.0:
            return 0.0
        return abs(self.residual) / allowed if allowed > 0.0 else math.inf

    def joined(self, other: Balance) -> Balance:
        """The balance of this part and of the `other`, which comes after it."""
        return Balance(
            self.residual + other.residual,
            self.loss + other.loss,
            self.turnover + other.turnover,
            max(self.stored, other.stored),
        )


def balance_of_run(energy: Energy) -> Balance:
    """The balance of a whole run."""
    turnover = sum(map(abs, energy.machines)) + abs(energy.kinetic) + abs(energy.elastic)
    return Balance(energy.residual, energy.loss, turnover, energy.stored)


def balance_of_window(window: Window) -> Balance:
    """The balance of a window of a twin; one that lies within a step tells nothing."""
    if math.isnan(window.residual_power):
        return Balance()
    duration = window.end - window.start
    passing = float(abs(window.machine_power).sum()) + abs(window.stored_power)
    return Balance(
        window.residual_power * duration,
        window.power_loss * duration,
        passing * duration,
        window.stored_energy,
    )


def ledger_warning(balance: Balance, tolerance: float) -> str | None:
    """A sentence where the ledger does not close, else None.

    Args:
        balance: of the run.
        tolerance: at which it was integrated.
    """
    if balance.excess <= 1.0:
        return None
    share = f"{abs(balance.residual / balance.loss):.2g} of the loss" if balance.loss else "no loss"
    return (
        f"the energy ledger does not close: {balance.residual:.3g} J of {balance.turnover:.3g} J "
        f"turned over are not accounted for ({share}), so losses and efficiency are uncertain by "
        f"as much; {advice(balance.excess, tolerance)}"
    )


def advice(excess: float, tolerance: float) -> str:
    """What to do about an `excess` above 1 at a `tolerance`."""
    tightest = TOLERANCES[0]
    if tolerance <= tightest:
        return f"the tolerance of {tightest:g} is the tightest: try another method"
    # Errors fall with the tolerance at least in proportion; the next power of ten, to be safe.
    tighter = max(10.0 ** math.floor(math.log10(tolerance / min(excess, 1.0 / tightest))), tightest)
    return f"tighten the tolerance from {tolerance:g} to {tighter:g}"
