"""A crack at the root of a tooth.

The crack starts at the critical section of ISO 6336-3 and is straight. The material above it,
between its tip and the cracked flank, carries no load: sections end at the depth of the crack tip,
unless the tooth is thinner there (Wu, Zuo and Parey 2008; Chen and Shao 2011). Contact and gear
body are as without a crack. The crack extends over the whole face width, is on the side in tension,
and does not pass the centre line.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .profile import ToothProfile

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Crack:
    """A crack."""

    depth: float = 0.0
    """Length [m]."""
    angle: float = math.radians(70.0)
    """Angle to the centre line of the tooth [rad]."""

    def thickness(self, profile: ToothProfile) -> Callable[[Floats], Floats]:
        """Thickness of the remaining sections.

        Args:
            profile: profile of the tooth.

        Returns:
            Thickness [m] as a function of the height [m].

        Raises:
            ValueError: the length is negative, or the crack passes the centre line.
        """
        start = profile.critical_height
        half = 0.5 * float(profile.thickness(np.array(start)))
        intact_half = half - self.depth * math.sin(self.angle)
        if self.depth < 0.0 or intact_half < 0.0:
            raise ValueError(
                f"depth of crack = {self.depth:g} m: must be within 0 and "
                f"{half / math.sin(self.angle):.3g} m, the centre line of the tooth"
            )

        def remaining(height: Floats) -> Floats:
            full = 0.5 * profile.thickness(height)
            return full + np.where(height >= start, np.minimum(full, intact_half), full)

        return remaining


NO_CRACK = Crack()
