"""Where a tape stands while time passes: playing at a rate, held, moved; needs no ROS."""

from __future__ import annotations

import math

AS_FAST_AS_IT_GOES = 0.0
"""A rate factor at which every instant is due at once."""


class Transport:
    """A position [ns] on a tape that runs with the steady clock, `rate_factor` times as fast.

    `now` is that clock's reading [s]. `limit` [ns] is the next instant to be played: as long as it
    is not, the tape has come no further, however late it is. So nothing jumps where the rate
    changes or the tape is held.
    """

    def __init__(self, position: int, rate_factor: float = 1.0) -> None:
        self._position = position
        self._since = 0.0
        self._rate_factor = rate_factor
        self.held = True

    @property
    def paced(self) -> bool:
        """Whether time limits how fast the tape runs, not the machine alone."""
        return self._rate_factor != AS_FAST_AS_IT_GOES

    def position(self, now: float, limit: int) -> int:
        """Where the tape stands [ns]."""
        if self.held:
            return self._position
        if not self.paced:
            return limit
        passed = round((now - self._since) * self._rate_factor * 1e9)
        return min(self._position + passed, limit)

    def remaining(self, instant: int, now: float) -> float:
        """Time until `instant` [s], negative if it is over; infinite while the tape is held."""
        if self.held:
            return math.inf
        if not self.paced:
            return 0.0
        due = (instant - self._position) * 1e-9 / self._rate_factor
        return due - (now - self._since)

    def hold(self, now: float, limit: int) -> None:
        """Stand still from now on."""
        self._position = self.position(now, limit)
        self.held = True

    def go(self, now: float) -> None:
        """Run from now on."""
        if self.held:
            self._since = now
            self.held = False

    def place(self, position: int, now: float) -> None:
        """Stand at `position` now, running or held as before."""
        self._position = position
        self._since = now

    def shift(self, by: int) -> None:
        """Count positions from elsewhere: what is due stays due, so that no error adds up."""
        self._position += by

    def set_rate(self, rate_factor: float, now: float, limit: int) -> None:
        """Run at another rate from where the tape stands now."""
        self.place(self.position(now, limit), now)
        self._rate_factor = rate_factor
