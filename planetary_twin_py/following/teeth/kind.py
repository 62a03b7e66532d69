"""Distinguishes a crack from wear of the same tooth, by a change of load.

At one load their signatures are similar. That of a crack is proportional to the torque, that of
wear is constant: mean amounts at different loads are compared with both laws.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

BETTER = 3.0  # units of log-likelihood by which one kind must be better than the other
CRACK, WEAR = "crack", "wear"


@dataclass
class _Sums:
    """Sums over the blocks of one cell."""

    blocks: int = 0
    torque: float = 0.0  # [N m]
    amount: float = 0.0
    variance: float = 0.0


@dataclass
class ToothKind:
    """Amounts of the signature of one tooth at several loads."""

    learning: int
    _cells: dict[int, _Sums] = field(default_factory=dict)

    def add(self, cell: int, torque: float, amount: float, sd: float) -> None:
        """Add the amount in one block of an operating cell, at an input torque [N m]."""
        sums = self._cells.setdefault(cell, _Sums())
        sums.blocks += 1
        sums.torque += torque
        sums.amount += amount
        sums.variance += sd**2

    def amount(self, cell: int) -> float:
        """Mean amount in a cell; 0 without any block."""
        sums = self._cells.get(cell)
        return sums.amount / sums.blocks if sums else 0.0

    @property
    def kinds(self) -> tuple[str, ...]:
        """Possible kinds, the more likely one first; one kind if the loads distinguish them."""
        misfits = self._misfits()
        order = sorted(misfits, key=lambda kind: misfits[kind])
        difference = 0.5 * (misfits[order[1]] - misfits[order[0]])
        return (order[0],) if difference > BETTER else (CRACK, WEAR)

    def _misfits(self) -> Mapping[str, float]:
        """Sums of squares of the residuals of both laws, by kind."""
        rows = []
        for sums in self._cells.values():
            count = sums.blocks
            variance = sums.variance / count * (1.0 / count + 1.0 / self.learning)
            rows.append((abs(sums.torque / count), sums.amount / count, variance))
        if len(rows) < 2:
            return {CRACK: 0.0, WEAR: 0.0}
        torque, amount, variance = np.array(rows).T
        misfits = {}
        for kind, law in ((CRACK, torque / torque.mean()), (WEAR, np.ones_like(torque))):
            amplitude = np.sum(law * amount / variance) / np.sum(law**2 / variance)
            misfits[kind] = float(np.sum((amount - amplitude * law) ** 2 / variance))
        return misfits
