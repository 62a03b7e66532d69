"""Baseline of a gearbox: its deviation of transmission error while it is as it should be."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from .hunting_blocks import HuntingBlock, without_common
from .tooth_scores import Bank

Array = NDArray[np.float64]

CELL = 0.1  # relative distance of torque and speed within which blocks share a baseline


@dataclass
class Baseline:
    """Of one operating cell: blocks at similar torque and speed.

    Args:
        torque: mean torque of the first block at the input [N m].
        speed: its speed of the input [rad/s].
        segment: of the encoders.
        needed: number of blocks from which it is learned.
    """

    torque: float
    speed: float
    segment: int
    needed: int
    bank: Bank | None = None
    """Signatures at this cell."""
    mean: Array | None = None
    """Deviation [m], (cycles, BINS), once learned."""
    sd: Array = field(default_factory=lambda: np.empty(0))
    """Standard deviation of the loss of a tooth in one block, by gear, (gears,)."""
    known: NDArray[np.bool_] = field(default_factory=lambda: np.empty(0, dtype=bool))
    """Where the mean is known, (cycles, BINS)."""
    _blocks: list[HuntingBlock] = field(default_factory=list)

    def covers(self, torque: float, speed: float, segment: int) -> bool:
        """Whether a block belongs to this cell.

        Args:
            torque: of the block [N m].
            speed: of the block [rad/s].
            segment: of the encoders.
        """
        near = abs(torque - self.torque) <= CELL * abs(self.torque)
        return (
            near and abs(speed - self.speed) <= CELL * abs(self.speed) and (segment == self.segment)
        )

    @property
    def count(self) -> int:
        """Blocks learned so far."""
        return len(self._blocks) if self.mean is None else self.needed

    @property
    def learned(self) -> bool:
        """Whether blocks can be judged."""
        return self.mean is not None

    def learn(self, block: HuntingBlock) -> None:
        """Take a block; the last one needed makes the baseline.

        Args:
            block: with the gearbox as it should be. `bank` must be set.
        """
        self._blocks.append(block)
        if len(self._blocks) < self.needed:
            return
        assert self.bank is not None  # set with the cell
        deviations = np.array([one.deviation for one in self._blocks])
        measured = np.array([one.measured for one in self._blocks])
        counts = measured.sum(axis=0)
        total = deviations.sum(axis=0)
        self.mean = total / np.maximum(counts, 1)
        self.known = counts >= self.needed // 2
        losses = []
        for one, there in zip(deviations, measured, strict=True):
            both = there & (counts > 1)
            others = np.where(both, (total - one) / np.maximum(counts - 1, 1), 0.0)
            product, square = self.bank.score(
                without_common(np.where(both, one - others, 0), both), both
            )
            losses.append(product / square)
        variance = np.mean(np.square(losses), axis=0) / (1.0 + 1.0 / (self.needed - 1))
        gears = range(len(self.bank.gears))
        self.sd = np.sqrt([np.mean(variance[self.bank.gear_of == g]) for g in gears])
        self._blocks.clear()

    def residual(self, block: HuntingBlock) -> tuple[Array, NDArray[np.bool_]]:
        """Deviation of a block from the baseline.

        Args:
            block: of this cell, or of a neighbouring one.

        Returns:
            Residual [m], 0 where it is not measured, and where it is, (cycles, BINS) each.
        """
        assert self.mean is not None  # only learned baselines judge
        there = block.measured & self.known
        return without_common(np.where(there, block.deviation - self.mean, 0.0), there), there
