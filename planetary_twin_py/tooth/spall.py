"""A spall: part of the flank over which a share of the face width has broken out."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


class Spall(NamedTuple):
    """Part of the path of contact with a shorter contact line.

    Only the contact line is shorter (Chaari, Baccar, Abbes and Haddar 2008). The pit is assumed to
    be too shallow to affect bending. The stiffness is discontinuous at both ends.
    """

    start: float = 0.0
    """Position after the pitch point [base pitches]."""
    end: float = 0.0
    """Position after the pitch point [base pitches]."""
    width: float = 0.0
    """Lost share of the face width, at least 0 and below 1."""

    def contact_share(self, position: Floats) -> Floats:
        """Share of the face width in contact, any shape.

        Args:
            position: position after the pitch point [base pitches], any shape.
        """
        within = (self.start <= position) & (position <= self.end)
        return np.where(within, 1.0 - self.width, 1.0)


NO_SPALL = Spall()
