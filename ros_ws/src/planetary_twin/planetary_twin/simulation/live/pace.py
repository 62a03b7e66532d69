"""Keeps simulated time in step with the steady clock."""

from __future__ import annotations

import time
from collections.abc import Callable


class Pace:
    """
    Absolute deadlines every `period` [s] of wall time, so that errors do not accumulate.

    A deadline missed by more than one period is an overrun: the schedule shifts to now, because
    a burst of intervals would only hide that the machine was too slow. With a period of 0, there
    are no waits and no overruns. `sleep` waits for a time [s]; it may return early.
    """

    def __init__(self, period: float, sleep: Callable[[float], object] = time.sleep) -> None:
        self._sleep = sleep
        self._period = round(period * 1e9)
        self._deadline = 0
        self.overruns = 0

    def start(self) -> None:
        """Start the first period now."""
        self._deadline = time.monotonic_ns() + self._period

    def wait(self) -> None:
        """Sleep until the end of the period in progress."""
        if not self._period:
            return
        remaining = self._deadline - time.monotonic_ns()
        if remaining > 0:
            self._sleep(remaining * 1e-9)
        elif -remaining > self._period:
            self.overruns += 1
            self._deadline -= remaining
        self._deadline += self._period
