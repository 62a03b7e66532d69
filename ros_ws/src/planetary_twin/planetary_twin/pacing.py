"""Keeps simulated time in step with the steady clock."""

from __future__ import annotations

import time
from collections.abc import Callable


class Pace:
    """Absolute deadlines every `period` seconds of wall time, so that no error adds up.

    A deadline missed by more than one period is an overrun: the schedule shifts to now, because
    catching up in a burst would only hide that the machine was too slow. `sleep` waits for a time
    [s], or less where there is something better to do.
    """

    def __init__(self, period: float, sleep: Callable[[float], object] = time.sleep) -> None:
        self._sleep = sleep
        self._period = round(period * 1e9)
        self._deadline = 0
        self.overruns = 0

    def start(self) -> None:
        """Let the first period begin now."""
        self._deadline = time.monotonic_ns() + self._period

    def wait(self) -> None:
        """Sleep until the end of the period in progress."""
        remaining = self._deadline - time.monotonic_ns()
        if remaining > 0:
            self._sleep(remaining * 1e-9)
        elif -remaining > self._period:
            self.overruns += 1
            self._deadline -= remaining
        self._deadline += self._period
