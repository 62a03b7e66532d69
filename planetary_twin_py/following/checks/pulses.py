"""Recognises a tachometer that counts pulses twice or misses some: its speed jumps by a factor.

A shaft with inertia turns exactly twice as fast from one reading to the next only by the sensor. A
brake may stop it so, but it does not turn as before again from one reading to the next.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

FACTORS = (2.0, 3.0, 0.5, 1.0 / 3.0)
NEAR = 0.01  # relative deviation within which a jump has one of these factors
STEADY = 0.02  # relative change of the readings before a jump
BEFORE = 3  # readings before a jump that must be steady
CLOSE = 0.05  # [s] between two readings; meanwhile a motor does not double its speed
AWAY = 0.25  # relative change from one reading to the next that is looked at
SETTLED = 2.0  # [s] after which the first speed counts as that of the shaft
LONGER = 3.0  # times as long as the level before, a level must last to count as that of the shaft
LONGEST = 60.0  # [s] after which another speed counts as that of the shaft


class Pulses:
    """Judges readings of a speed in the order of their arrival, above a least magnitude [rad/s]."""

    def __init__(self, least: float) -> None:
        self._least = least
        self._last: tuple[Array, Array] = np.empty(0), np.empty(0)  # stamps and readings
        self._factor = 1.0  # by which the sensor counts too many pulses
        self._since = math.nan  # begin of the present level [s]
        self._earlier = SETTLED / LONGER  # [s] for which the level before lasted
        self._left = 0.0  # speed from which the present level of 0 has been reached [rad/s]
        self._zeros: list[Array] = []  # stamps and rows of this level, (2, m) each
        self.stops: list[Array] = []
        """Stamps [s] and rows of each level of 0 that the last call of `judge` saw end, (2, m)."""

    def judge(self, time: Array, values: Array, rows: Array) -> dict[str, NDArray[np.bool_]]:
        """Masks of readings [rad/s], (n,), with extra or lost pulses, by reason."""
        self.stops = []
        known = np.flatnonzero(np.isfinite(values) & np.isfinite(time))
        begin = len(self._last[0])
        stamps = np.concatenate([self._last[0], time[known]])
        read = np.concatenate([self._last[1], values[known]])
        factors = np.ones(len(known))
        if math.isnan(self._since) and len(known):
            self._since = float(stamps[0])
        first = 0
        for k in [*self._changes(read, begin), len(read)]:
            until = min(k, int(np.searchsorted(stamps, self._since + LONGEST)))
            factors[first : max(until - begin, first)] = self._factor
            level = known[first : k - begin]
            if until < k or values[level].any():
                self._left = 0.0
            if self._left:
                self._zeros.append(np.stack([time[level], rows[level]]))
            if k < len(read):
                before = slice(max(k - BEFORE, 0), k + 1)
                self._note(stamps[before], read[before])
                first = k - begin
        self._last = stamps[-BEFORE:], read[-BEFORE:]
        found = {}
        for factor in FACTORS:
            which = np.zeros(len(values), dtype=bool)
            which[known] = factors == factor
            found[_reason(factor)] = which
        return found

    def _changes(self, read: Array, begin: int) -> list[int]:
        """Indices, from `begin` on, of readings far from the one before."""
        slow = np.abs(read) < self._least
        far = np.abs(read[1:] - read[:-1]) >= AWAY * np.abs(read[:-1])
        changed = np.where(slow[1:] | slow[:-1], slow[1:] != slow[:-1], far)
        return [k for k in (np.flatnonzero(changed) + 1).tolist() if k >= begin]

    def _note(self, stamps: Array, read: Array) -> None:
        """Note a change of the last of some readings."""
        now, before = float(stamps[-1]), read[:-1]
        lasted = now - self._since
        settled = self._factor == 1.0 and lasted >= LONGER * self._earlier
        self._since, self._earlier, self._factor = now, lasted, 1.0
        close = len(stamps) > 1 and 0.0 < now - stamps[-2] < CLOSE
        if close and self._left and abs(read[-1] - self._left) <= STEADY * abs(self._left):
            self.stops.append(np.concatenate(self._zeros, axis=1))
        steady = close and len(before) == BEFORE and np.ptp(before) <= STEADY * abs(before[-1])
        self._left = float(before[-1]) if steady and read[-1] == 0.0 else 0.0
        self._zeros = []
        if settled and steady:
            for factor in FACTORS:
                if abs(read[-1] - before[-1] * factor) < NEAR * abs(before[-1] * factor):
                    self._factor = factor


def _reason(factor: float) -> str:
    if factor > 1.0:
        return f"the speed jumps by {factor:g} between two readings, as with extra pulses"
    return f"the speed falls to 1/{1.0 / factor:g} between two readings, as with lost pulses"
