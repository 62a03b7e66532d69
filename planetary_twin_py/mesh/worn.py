"""Worn profile of the flanks of a mesh: missing material of its pairs along the path of contact."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

BENT = 0.2  # change of the slope, over the steepest one, that counts as a kink
MOST_KINKS = 8  # the sharpest ones


class Worn(NamedTuple):
    """Depths of both flanks of a pair together, linear between positions and constant outside."""

    position: np.ndarray
    """After the pitch point [base pitches], increasing, (n,)."""
    depth: np.ndarray
    """[m], (n,)."""

    def at(self, position: np.ndarray) -> np.ndarray:
        """Missing material [m] of pairs at positions after the pitch point [base pitches]."""
        return np.interp(position, self.position, self.depth)

    @property
    def kinks(self) -> tuple[float, ...]:
        """Positions at which the profile bends sharply [base pitches].

        Between them, a polynomial follows the profile.
        """
        slope = np.diff(self.depth) / np.diff(self.position)
        bend = np.abs(np.diff(slope))
        sharp = np.flatnonzero(bend > BENT * np.abs(slope).max())
        sharpest = sorted(sharp, key=lambda n: -bend[n])[:MOST_KINKS]
        return tuple(float(self.position[n + 1]) for n in sorted(sharpest))
