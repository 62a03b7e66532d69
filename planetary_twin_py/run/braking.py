"""The brake of an input shaft: constant deceleration to rest, from any speed."""

from __future__ import annotations

import math
from typing import NamedTuple

from ..model.clock import TICKS

LONGEST = 10**18  # [ticks] of a brake: the core counts them in 64 bits


class Braking(NamedTuple):
    """Course of the speed of a shaft that is braked."""

    begin: int
    """Start of the brake, in ticks of the clock."""
    speed: float
    """Speed at the start [rad/s]."""
    rest: int
    """Time from which the shaft is at rest, in ticks of the clock."""

    def at(self, ticks: int) -> float:
        """Speed [rad/s] at a time after the start, in ticks of the clock."""
        left = max(self.rest - ticks, 0)
        return self.speed * left / (self.rest - self.begin) if left else 0.0


def braking(begin: int, speed: float, deceleration: float) -> Braking:
    """Course of a brake.

    Args:
        begin: its start, in ticks of the clock.
        speed: speed of the shaft at the start [rad/s].
        deceleration: magnitude [rad/s^2].

    Returns:
        The course, v = v0 - a t until v = 0.
    """
    duration = min(math.ceil(abs(speed) / deceleration * TICKS), LONGEST)
    return Braking(begin, speed, begin + duration)
