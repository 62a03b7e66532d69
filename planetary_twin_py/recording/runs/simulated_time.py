"""The simulated time of messages that have a stamp only."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
PAUSE = 1_000_000_000  # [ns]; larger differences of stamps and simulated time are pauses


class SimulatedTime:
    """Maps stamps to the simulated time of a twin, by the stamps of its states.

    A state covers its interval, so a pause or a skip of stamps lies before it. Stamps before the
    first state and after the last run with simulated time.

    Args:
        stamp: of the states [ns], (n,), at least one.
        time: simulated time of the states [s], (n,).
        interval: that each covers [s], (n,).
    """

    def __init__(self, stamp: NDArray[np.int64], time: Array, interval: Array) -> None:
        begin = stamp - np.rint(1e9 * interval).astype(np.int64)
        adjoining = 1 + np.flatnonzero(np.abs(begin[1:] - stamp[:-1]) <= PAUSE)
        begin[adjoining] = stamp[adjoining - 1]
        self._first = int(begin[0])
        self._stamp = 1e-9 * (np.stack((begin, stamp), axis=1).ravel() - self._first)
        self._time = np.stack((time - interval, time), axis=1).ravel()

    def __call__(self, stamp: NDArray[np.int64]) -> Array:
        """Simulated time [s] of stamps [ns], (n,)."""
        seconds = 1e-9 * (stamp - self._first)
        time = np.interp(seconds, self._stamp, self._time)
        time += np.minimum(seconds - self._stamp[0], 0.0)
        time += np.maximum(seconds - self._stamp[-1], 0.0)
        return np.asarray(time, dtype=np.float64)
