"""A spall: a stretch of the flank over which part of the face width has broken out."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


class Spall(NamedTuple):
    """Where contact is lost: `start` to `end` in base pitches past the pitch point.

    `width` is the share of the face width that is lost there, at least 0 and below 1. Only the
    contact is shorter (Chaari, Baccar, Abbes and Haddar 2008); the pit is taken as too shallow for
    the tooth to bend more. The law jumps at both ends of the stretch.
    """

    start: float = 0.0
    end: float = 0.0
    width: float = 0.0

    def contact_share(self, position: Floats) -> Floats:
        """Share of the face width in contact, for positions in base pitches."""
        within = (self.start <= position) & (position <= self.end)
        return np.where(within, 1.0 - self.width, 1.0)


NO_SPALL = Spall()
