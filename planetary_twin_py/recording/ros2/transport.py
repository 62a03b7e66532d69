"""Playback position over time: playing at a rate, paused or moved; needs no ROS."""

from __future__ import annotations

import math

AS_FAST_AS_IT_GOES = 0.0
"""Rate factor for playback as fast as possible."""


class Transport:
    """Playback position [ns] that advances with the steady clock, `rate_factor` times as fast.

    In all methods `now` is the reading of that clock [s], and `limit` [ns] the time of the next
    message: the position does not exceed it, even if playback is late, so that a pause or a change
    of rate causes no jump.
    """

    def __init__(self, position: int, rate_factor: float = 1.0) -> None:
        self._position = position
        self._since = 0.0
        self._rate_factor = rate_factor
        self.held = True

    @property
    def paced(self) -> bool:
        """Whether the clock limits the playback rate, not only the machine."""
        return self._rate_factor != AS_FAST_AS_IT_GOES

    def position(self, now: float, limit: int) -> int:
        """Present position [ns]."""
        if self.held:
            return self._position
        if not self.paced:
            return limit
        passed = round((now - self._since) * self._rate_factor * 1e9)
        return min(self._position + passed, limit)

    def remaining(self, instant: int, now: float) -> float:
        """Time until `instant` [s], negative if it is late; infinite while paused."""
        if self.held:
            return math.inf
        if not self.paced:
            return 0.0
        due = (instant - self._position) * 1e-9 / self._rate_factor
        return due - (now - self._since)

    def pause(self, now: float, limit: int) -> None:
        """Pause."""
        self._position = self.position(now, limit)
        self.held = True

    def resume(self, now: float) -> None:
        """Resume."""
        if self.held:
            self._since = now
            self.held = False

    def place(self, position: int, now: float) -> None:
        """Move to `position`; playing or paused as before."""
        self._position = position
        self._since = now

    def shift(self, by: int) -> None:
        """Shift the origin of positions; due times stay the same, so errors do not add up."""
        self._position += by

    def set_rate(self, rate_factor: float, now: float, limit: int) -> None:
        """Change the rate at the present position."""
        self.place(self.position(now, limit), now)
        self._rate_factor = rate_factor
