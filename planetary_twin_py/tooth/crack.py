"""A crack at the root of a tooth.

It starts at the critical section of ISO 6336-3 and runs straight into the tooth. What lies above
it, between its tip and the cracked flank, carries nothing: there the section ends at the tip of
the crack, up to where the tooth is thinner than that anyway (Wu, Zuo and Parey 2008; Chen and
Shao 2011). Contact and gear body are as without a crack. The crack is as wide as the face, on the
side that the load opens; it stays on its own side of the centre line.
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
    """Crack of length `depth` [m] at `angle` [rad] to the centre line of the tooth."""

    depth: float = 0.0
    angle: float = math.radians(70.0)

    def thickness(self, profile: ToothProfile) -> Callable[[Floats], Floats]:
        """Thickness [m] of what still bends of the tooth `profile`, by height [m].

        Raises:
            ValueError: the crack has a negative length or passes the centre line.
        """
        start = profile.critical_height
        half = 0.5 * float(profile.thickness(np.array(start)))
        left = half - self.depth * math.sin(self.angle)
        if self.depth < 0.0 or left < 0.0:
            raise ValueError(
                f"depth of crack = {self.depth:g} m: must be within 0 and "
                f"{half / math.sin(self.angle):.3g} m, the centre line of the tooth"
            )

        def remaining(height: Floats) -> Floats:
            full = 0.5 * profile.thickness(height)
            return full + np.where(height >= start, np.minimum(full, left), full)

        return remaining


NO_CRACK = Crack()
