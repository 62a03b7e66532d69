"""Baseline of a gearbox: the deviation of its transmission error in healthy condition."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from hashlib import sha256
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .baseline_fields import FIELDS
from .hunting_blocks import HuntingBlock, without_common
from .scores import Bank

Array = NDArray[np.float64]

MOVED = 6.5  # standard deviations by which another position must explain a block better
CELL = 0.1  # relative distance of torque and speed within which blocks share a baseline


class LearnedCell(NamedTuple):
    """Learning state of one operating cell: similar torque and speed."""

    torque: float
    """Mean input torque of the first hunting period [N m]."""
    speed: float
    """Mean input speed of the first hunting period [rad/s]."""
    segment: int
    """Number of times that the encoders have lost the count of turns."""
    periods: int
    """Hunting periods so far."""
    needed: int
    """Hunting periods of a baseline."""
    digest: str
    """Digest of the baseline, once it is learned; empty before."""


@dataclass
class Baseline:
    """Baseline of one operating cell: blocks at similar torque and speed.

    Args:
        torque: mean input torque of the first block [N m].
        speed: mean input speed of the first block [rad/s].
        segment: number of times that the encoders have lost the count of turns.
        needed: number of blocks from which the baseline is learned.
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
    taken_off: bool = False
    """Whether it was learned with changed teeth, whose contributions were subtracted."""
    slope: Array = field(default_factory=lambda: np.empty(0))
    """Change of the deviation with torque [m/(N m)], (cycles, BINS)."""
    digest: str = ""
    """Digest of the mean and its scatter, once learned."""
    _centre: float = 0.0  # mean torque of its blocks [N m]
    _spread: float = 1.0  # sum of squares of their torques about it, with a penalty [N^2 m^2]
    _blocks: list[tuple[HuntingBlock, float]] = field(default_factory=list)

    def fields(self) -> dict[str, NDArray[Any]]:
        """Values of a learned baseline, from which `of_fields` makes it again."""
        assert self.mean is not None  # called for learned baselines only
        return {name: np.array(getattr(self, name)) for name in FIELDS["teeth"]}

    @classmethod
    def of_fields(cls, fields: Mapping[str, NDArray[Any]], segment: int) -> Baseline:
        """A learned baseline of the values of `fields`."""
        values: dict[str, Any] = {
            name: value.item() if value.ndim == 0 else value for name, value in fields.items()
        }
        return cls(**values, segment=segment)

    def moved(self, block: HuntingBlock) -> bool:
        """Whether a block shows the deviation of the baseline at another position of the gears.

        Another number of mesh cycles between both then explains it far better than none.
        """
        assert self.mean is not None  # called for learned baselines only
        both_measured = block.measured & self.known
        deviation, mean = (
            np.where(both_measured, block.deviation, 0.0),
            np.where(self.known, self.mean, 0.0),
        )
        product = np.fft.rfft(deviation, axis=0) * np.conj(np.fft.rfft(mean, axis=0))
        correlation = np.fft.irfft(product.sum(axis=1), len(mean))
        shift, baseline_energy = int(np.argmax(correlation)), float(np.sum(mean**2))
        residual_energy = (
            float(np.sum(deviation**2)) + baseline_energy - 2.0 * float(correlation[shift])
        )
        sd = math.sqrt(2.0 * baseline_energy * max(residual_energy, 0.0) / both_measured.sum())
        return shift != 0 and float(correlation[shift] - correlation[0]) > MOVED * sd

    def covers(self, torque: float, speed: float, segment: int) -> bool:
        """Whether a block at an input torque [N m] and speed [rad/s] belongs to this cell."""
        similar_torque = abs(torque - self.torque) <= CELL * abs(self.torque)
        return (
            similar_torque
            and abs(speed - self.speed) <= CELL * abs(self.speed)
            and (segment == self.segment)
        )

    @property
    def count(self) -> int:
        """Blocks learned so far."""
        return len(self._blocks) if self.mean is None else self.needed

    @property
    def learned(self) -> bool:
        """Whether blocks can be judged."""
        return self.mean is not None

    @property
    def summary(self) -> LearnedCell:
        """The learning state."""
        return LearnedCell(
            self.torque, self.speed, self.segment, self.count, self.needed, self.digest
        )

    def learn(self, block: HuntingBlock, torque: float) -> None:
        """Add a block of the healthy gearbox; the last one needed completes the baseline.

        With runout, the deviation changes with the torque. This is learned, too.
        """
        self._blocks.append((block, torque))
        if len(self._blocks) < self.needed:
            return
        assert self.bank is not None  # set with the cell
        deviations = np.array([past.deviation for past, _ in self._blocks])
        measured = np.array([past.measured for past, _ in self._blocks])
        torques = np.array([past_torque for _, past_torque in self._blocks])
        counts = measured.sum(axis=0)
        self.known = counts >= self.needed // 2
        self.mean = deviations.sum(axis=0) / np.maximum(counts, 1)
        self._centre = float(torques.mean())
        torque_offsets = torques - self._centre
        both_measured = measured & self.known
        residuals = np.where(both_measured, deviations - self.mean, 0.0)
        losses = self._tooth_losses(residuals, both_measured)
        # Ridge regression: a deviation that is proportional to the torque has the slope of its mean
        # over the torque, so that of a small one is known to be small (Hoerl and Kennard 1970).
        of_mean = self._tooth_losses(np.where(self.known, self.mean, 0.0)[None], self.known[None])
        penalty = self._centre**2 * float(np.mean(losses**2) / np.mean(of_mean**2))
        self._spread = float(torque_offsets @ torque_offsets) + penalty or 1.0
        self.slope = np.tensordot(torque_offsets, residuals, 1) / self._spread
        residuals -= np.where(both_measured, torque_offsets[:, None, None] * self.slope, 0.0)
        losses = self._tooth_losses(residuals, both_measured)
        leverage = 1.0 / self.needed + torque_offsets**2 / self._spread
        variance = np.mean(np.square(losses) / (1.0 - leverage[:, None]), axis=0)
        gears = range(len(self.bank.gears))
        self.sd = np.sqrt([np.mean(variance[self.bank.gear_of == g]) for g in gears])
        self.digest = sha256(self.mean.tobytes() + self.sd.tobytes()).hexdigest()[:16]
        self._blocks.clear()

    def _tooth_losses(self, residuals: Array, masks: NDArray[np.bool_]) -> Array:
        """Loss of every tooth alone in every block, (blocks, teeth)."""
        assert self.bank is not None  # set with the cell
        losses = []
        for residual, measured in zip(residuals, masks, strict=True):
            product, square = self.bank.score(without_common(residual, measured), measured)
            losses.append(product / square)
        return np.array(losses)

    def noise(self, torques: Array) -> float:
        """Standard deviation of a mean over blocks at torques [N m], (n,), over that of one block.

        It contains the uncertainty of the baseline.
        """
        offset = float(np.mean(torques)) - self._centre
        return math.sqrt(1.0 / len(torques) + 1.0 / self.needed + offset**2 / self._spread)

    def residual(self, block: HuntingBlock, torque: float) -> tuple[Array, NDArray[np.bool_]]:
        """Deviation from the baseline [m], 0 where not measured, and a mask; (cycles, BINS)."""
        assert self.mean is not None  # called for learned baselines only
        measured = block.measured & self.known
        expected = self.mean + (torque - self._centre) * self.slope
        return without_common(
            np.where(measured, block.deviation - expected, 0.0), measured
        ), measured
