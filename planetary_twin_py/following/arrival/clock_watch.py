"""Estimates the skew and the offset of senders' clocks from stamps and times of arrival.

The lower envelope of arrival minus stamp is free of network delays (Moon, Skelly and Towsley 1999,
IEEE INFOCOM, 227-234). The minimum of each time window is kept, and the slope of a line through
the minima is the skew.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

WINDOW = 10.0  # [s] length of a window
MOST = 60  # windows that are kept
FEWEST = 6  # windows that a skew needs
SKEW = 50e-6  # skew that causes a remark
APART = 10e-3  # [s] difference of two senders' offsets that causes a remark


@dataclass
class _Sender:
    lowest: dict[int, tuple[float, float]] = field(default_factory=dict)
    """Stamp and delay [s] of the reading with the smallest delay, by window."""

    def add(self, stamp: Array, arrival: Array) -> None:
        window = np.floor(stamp / WINDOW).astype(np.int64)
        delay = arrival - stamp
        for number in np.unique(window):
            inside = np.flatnonzero(window == number)
            smallest = inside[np.argmin(delay[inside])]
            candidate = float(stamp[smallest]), float(delay[smallest])
            stored = self.lowest.get(int(number))
            if stored is None or candidate[1] < stored[1]:
                self.lowest[int(number)] = candidate
        for number in sorted(self.lowest)[:-MOST]:
            del self.lowest[number]

    @property
    def skew(self) -> float:
        """Seconds per second by which the clock lags; NaN with too few windows."""
        if len(self.lowest) < FEWEST:
            return math.nan
        stamp, delay = np.array([self.lowest[n] for n in sorted(self.lowest)[:-1]]).T
        return float(np.polyfit(stamp - stamp[0], delay, 1)[0])

    @property
    def offset(self) -> float:
        """Smallest delay of arrival in the last complete window [s]; NaN without one."""
        numbers = sorted(self.lowest)
        return self.lowest[numbers[-2]][1] if len(numbers) > 1 else math.nan


@dataclass
class ClockWatch:
    """Clocks of all senders."""

    _senders: dict[str, _Sender] = field(default_factory=dict)

    def add(self, sender: str, stamp: Array, arrival: Array) -> None:
        """Add stamps of a sender, and times of arrival by the clock of the receiver [s], (n,)."""
        finite = np.isfinite(stamp) & np.isfinite(arrival)
        if finite.any():
            self._senders.setdefault(sender, _Sender()).add(stamp[finite], arrival[finite])

    def remarks(self) -> Iterator[str]:
        """Faults of the clocks, one line each."""
        for name, sender in self._senders.items():
            if abs(sender.skew) > SKEW:
                yield f"clock of {name}: skew of {1e6 * sender.skew:.0f} ppm"
        offsets = {
            name: sender.offset
            for name, sender in self._senders.items()
            if math.isfinite(sender.offset)
        }
        if len(offsets) < 2:
            return
        last, first = max(offsets, key=lambda n: offsets[n]), min(offsets, key=lambda n: offsets[n])
        difference = offsets[last] - offsets[first]
        if difference > APART:
            yield f"clocks of {first} and {last}: stamps differ by {1e3 * difference:.0f} ms"
