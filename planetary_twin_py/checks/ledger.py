"""Check of the energy ledger of a run, on which the accuracy of its losses depends.

The residual of the energy balance is an error of the integration, and the losses are uncertain by
the same amount. It must be at most 1 % of the loss, or 1e-5 of the turnover if losses are small.
At standstill all of these vanish; residuals far below any energy in a gearbox are allowed.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from ..run.energy import ROUNDING, Energy
from ..run.tolerance import TOLERANCES
from ..run.window import Window

OF_LOSS = 0.01  # allowed residual/loss
OF_TURNOVER = 1e-5  # allowed residual/turnover, for trains with small losses
OF_STORED = ROUNDING  # allowed residual/stored energy
FLOOR = 1e-15  # [J] allowed at standstill; a tooth of 1e8 N/m pressed by 1 mN stores 5e-15 J


class Balance(NamedTuple):
    """Energy balance of a run, or of a part of it [J]."""

    residual: float = 0.0
    """Of the energy balance [J]."""
    loss: float = 0.0
    """Dissipated by tooth friction, bearings, seals and churning [J]."""
    turnover: float = 0.0
    """Sum of the absolute values of the work of all machines and of the changes in energy [J]."""
    stored: float = 0.0
    """Kinetic and elastic energy [J]."""

    @property
    def excess(self) -> float:
        """Residual over allowed residual; the ledger balances if it is at most 1."""
        allowed = max(
            OF_LOSS * abs(self.loss), OF_TURNOVER * self.turnover, OF_STORED * self.stored, FLOOR
        )
        return abs(self.residual) / allowed

    def joined(self, other: Balance) -> Balance:
        """Balance of this part of a run together with the following part.

        Args:
            other: balance of the following part.
        """
        return Balance(
            self.residual + other.residual,
            self.loss + other.loss,
            self.turnover + other.turnover,
            max(self.stored, other.stored),
        )


def balance_of_run(energy: Energy) -> Balance:
    """Balance of a run.

    Args:
        energy: its ledger.
    """
    passing = sum(map(abs, energy.machines)) + 2.0 * energy.both_ways
    turnover = passing + abs(energy.kinetic) + abs(energy.elastic)
    return Balance(energy.residual, energy.loss, turnover, energy.stored)


def balance_of_window(window: Window) -> Balance:
    """Balance of a window of a twin.

    Args:
        window: of the twin.
    """
    duration = window.end - window.start
    passing = float(abs(window.machine_power).sum()) + abs(window.stored_power)
    return Balance(
        window.residual_power * duration,
        window.power_loss * duration,
        passing * duration,
        window.stored_energy,
    )


def ledger_warning(balance: Balance, tolerance: float) -> str | None:
    """Warning if the ledger does not balance.

    Args:
        balance: of the run.
        tolerance: of the integration.

    Returns:
        A sentence, or None if the ledger balances.
    """
    if balance.excess <= 1.0:
        return None
    share = f"{abs(balance.residual / balance.loss):.2g} of the loss" if balance.loss else "no loss"
    return (
        f"the energy ledger does not balance: the residual is {balance.residual:.3g} J of a "
        f"turnover of {balance.turnover:.3g} J ({share}), so losses and efficiency are uncertain "
        f"by the same amount; {advice(balance.excess, tolerance)}"
    )


def advice(excess: float, tolerance: float) -> str:
    """Recommended change of the tolerance or the method.

    Args:
        excess: residual over allowed residual, above 1.
        tolerance: of the integration.
    """
    tightest = TOLERANCES[0]
    if tolerance <= tightest:
        return f"the tolerance {tightest:g} is the tightest: use another method"
    # Errors decrease at least in proportion to the tolerance; rounded to the next power of ten.
    tighter = max(10.0 ** math.floor(math.log10(tolerance / min(excess, 1.0 / tightest))), tightest)
    return f"tighten the tolerance from {tolerance:g} to {tighter:g}"
