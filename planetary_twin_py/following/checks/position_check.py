"""Compares the measured speed of a shaft with its measured positions, and states what differs.

Positions are not used otherwise. A driver may leave them at 0, or write turns or degrees, so they
show no unit of the speed: the reader concludes.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from .checks import CHECKED

FITS = 0.02  # relative deviation within which two rates agree
FEWEST = 50  # pairs of readings that are needed
TURNED = 2.5  # rad between two readings above which positions within a turn are ambiguous


@dataclass
class PositionCheck:
    """Compares speeds and positions of a shaft in the first seconds in which it turns."""

    channel: str
    scale: float = 1.0
    remark: str = ""
    """What is wrong with the positions; empty if nothing is known to be."""
    _rows: list[tuple[float, float, float]] = field(default_factory=list)
    _done: bool = False

    def add(self, stamp: float, position: float, speed: float) -> None:
        """Add the position [rad] and the speed, by definition in rad/s, at a stamp [s]."""
        if self._done or not all(map(math.isfinite, (stamp, position, speed))):
            return
        if self._rows and stamp <= self._rows[-1][0]:
            return
        self._rows.append((stamp, position, self.scale * speed))
        if stamp - self._rows[0][0] >= CHECKED:
            self._check()
            self._rows.clear()

    def remarks(self) -> Iterator[str]:
        """A line on positions that are not those of a shaft with the measured speed."""
        if self.remark:
            yield self.remark

    def _check(self) -> None:
        stamp, position, speed = np.array(self._rows).T
        turned = 0.5 * (speed[1:] + speed[:-1]) * np.diff(stamp)
        rows = np.abs(turned) > FITS
        if rows.sum() < FEWEST:
            return  # the shaft is at rest, or readings are slow
        self._done = True
        turned, moved = turned[rows], np.diff(position)[rows]
        rate = f"{self.channel} = {float(np.median(speed)):.4g} rad/s"
        if not moved.any():
            self.remark = f"{rate}, but the positions of this shaft do not move: they are not used"
            return
        whole = 2.0 * math.pi
        if np.median(np.abs(turned - moved - whole * np.round((turned - moved) / whole))) < FITS:
            return
        if np.median(np.abs(moved)) > TURNED:
            return
        ratio = float(np.median(turned) / np.median(moved)) if np.median(moved) else math.inf
        self.remark = (
            f"{rate} is {ratio:.4g} times the rate of the positions of this shaft: JointState has "
            f"rad/s and rad; a speed in another unit needs --scale {self.channel}=FACTOR; "
            "positions are not used"
        )
