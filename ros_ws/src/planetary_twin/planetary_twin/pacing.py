"""Keeps simulated time in step with the steady clock."""

from __future__ import annotations

import time
from collections.abc import Callable

SLOWEST, FASTEST = 0.01, 100.0
"""Simulated seconds per second."""
AS_FAST_AS_IT_GOES = 0.0
"""Stands for a rate factor that only the machine limits."""


def check_rate_factor(rate_factor: float) -> None:
    """Raise `ValueError` for one that cannot be."""
    if rate_factor != AS_FAST_AS_IT_GOES and not SLOWEST <= rate_factor <= FASTEST:
        raise ValueError(
            f"rate_factor = {rate_factor:g}: must be within {SLOWEST:g} and {FASTEST:g}, "
            f"or {AS_FAST_AS_IT_GOES:g} for as fast as it goes"
        )


class Pace:
    """
    Absolute deadlines every `period` seconds of wall time, so that no error adds up.

    A deadline missed by more than one period is an overrun: the schedule shifts to now, because
    catching up in a burst would only hide that the machine was too slow. With a period of 0
    nothing waits and nothing is late. `sleep` waits for a time [s], or less where there is
    something better to do.
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
        if not self._period:
            return
        remaining = self._deadline - time.monotonic_ns()
        if remaining > 0:
            self._sleep(remaining * 1e-9)
        elif -remaining > self._period:
            self.overruns += 1
            self._deadline -= remaining
        self._deadline += self._period
