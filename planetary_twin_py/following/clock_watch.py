"""Watches the clocks of senders: by how much the stamps of each run apart from its arrivals.

The lower envelope of arrival less stamp is free of delays in the network (Moon, Skelly and Towsley
1999, IEEE INFOCOM, 227-234). Of each window of time the least is kept, and a line through them
gives the skew.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

WINDOW = 10.0  # [s]
MOST = 60  # windows
FEWEST = 6  # windows
SKEW = 50e-6  # that is remarked upon
APART = 10e-3  # [s] between two senders that is remarked upon


@dataclass
class _Sender:
    least: dict[int, tuple[float, float]] = field(default_factory=dict)  # stamp and difference

    def add(self, stamp: Array, arrival: Array) -> None:
        window = np.floor(stamp / WINDOW).astype(np.int64)
        late = arrival - stamp
        for number in np.unique(window):
            inside = np.flatnonzero(window == number)
            best = inside[np.argmin(late[inside])]
            found = float(stamp[best]), float(late[best])
            known = self.least.get(int(number))
            if known is None or found[1] < known[1]:
                self.least[int(number)] = found
        for number in sorted(self.least)[:-MOST]:
            del self.least[number]

    @property
    def skew(self) -> float:
        """Seconds per second by which its clock lags; NaN while it is not known."""
        if len(self.least) < FEWEST:
            return math.nan
        stamp, late = np.array([self.least[n] for n in sorted(self.least)[:-1]]).T
        return float(np.polyfit(stamp - stamp[0], late, 1)[0])

    @property
    def offset(self) -> float:
        """Least delay of arrival in the last complete window [s]; NaN before."""
        numbers = sorted(self.least)
        return self.least[numbers[-2]][1] if len(numbers) > 1 else math.nan


@dataclass
class ClockWatch:
    """The clocks of all senders."""

    _senders: dict[str, _Sender] = field(default_factory=dict)

    def add(self, sender: str, stamp: Array, arrival: Array) -> None:
        """Take readings.

        Args:
            sender: its name.
            stamp: times at which they were taken, by its clock [s], (n,).
            arrival: times at which they arrived, by the clock of the receiver [s], (n,).
        """
        there = np.isfinite(stamp) & np.isfinite(arrival)
        if there.any():
            self._senders.setdefault(sender, _Sender()).add(stamp[there], arrival[there])

    def remarks(self) -> Iterator[str]:
        """What is wrong with the clocks, a line each."""
        for name, sender in self._senders.items():
            if abs(sender.skew) > SKEW:
                yield f"clock of {name}: runs apart by {1e6 * sender.skew:.0f} ppm"
        offsets = {
            name: sender.offset
            for name, sender in self._senders.items()
            if math.isfinite(sender.offset)
        }
        if len(offsets) < 2:
            return
        last, first = max(offsets, key=lambda n: offsets[n]), min(offsets, key=lambda n: offsets[n])
        apart = offsets[last] - offsets[first]
        if apart > APART:
            yield f"clocks of {first} and {last}: stamps differ by {1e3 * apart:.0f} ms"
