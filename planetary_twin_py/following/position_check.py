"""Recognises the unit of a measured speed by the measured positions.

Speed times the time between two readings must equal the difference of their positions, up to whole
turns, because positions may be reduced to one turn.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from .checks import CHECKED, InputError
from .contradictions import RPM

FITS = 0.02  # turns, largest median deviation of a unit that fits
FEWEST = 50  # pairs of readings that are needed
LEAST = 0.0025  # turns between two readings below which the shaft is at rest
UNITS = {"rpm": 1.0 / RPM, "deg/s": math.pi / 180.0}


@dataclass
class PositionCheck:
    """Compares speeds and positions of a shaft in the first seconds in which it turns.

    Args:
        channel: name of the channel of the speed.
        scale: factor on its readings.
    """

    channel: str
    scale: float = 1.0
    _rows: list[tuple[float, float, float]] = field(default_factory=list)
    _done: bool = False

    def add(self, stamp: float, position: float, speed: float) -> None:
        """Add a reading.

        Args:
            stamp: stamp of the reading [s].
            position: position of the shaft [rad].
            speed: speed of the shaft, by definition in rad/s.

        Raises:
            InputError: another unit of the speed fits the positions, and rad/s does not.
        """
        if self._done or not all(map(math.isfinite, (stamp, position, speed))):
            return
        if self._rows and stamp <= self._rows[-1][0]:
            return
        self._rows.append((stamp, position, self.scale * speed))
        if stamp - self._rows[0][0] >= CHECKED:
            self._check()
            self._rows.clear()

    def _check(self) -> None:
        stamp, position, speed = np.array(self._rows).T
        turned = 0.5 * (speed[1:] + speed[:-1]) * np.diff(stamp) / (2.0 * math.pi)
        moved = np.diff(position) / (2.0 * math.pi)
        self._done = bool(np.median(np.abs(turned)) > FITS)  # any unit fits a slower shaft
        if len(turned) < FEWEST or _deviation(turned, moved) < FITS:
            return
        for unit, factor in UNITS.items():
            enough = float(np.median(np.abs(turned * factor))) > LEAST
            if enough and _deviation(turned * factor, moved) < FITS:
                raise InputError(
                    f"{self.channel} = {float(np.median(speed)):.4g} rad/s: the positions of this "
                    f"shaft give {float(np.median(speed)) * factor:.4g}; it is probably in {unit}: "
                    f"scale {self.channel} by {factor * self.scale:.6g}"
                )


def _deviation(turned: np.ndarray, moved: np.ndarray) -> float:
    """Median deviation from whole turns."""
    difference = turned - moved
    return float(np.median(np.abs(difference - np.round(difference))))
