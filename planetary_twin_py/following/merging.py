"""Merges the readings of several senders independently of the order of arrival between them.

The middleware keeps the order of the messages of one sender, but not that between senders: a
recorder may receive the same messages in another order. So each sender has bins of its own, which
depend on its messages only. A bin is used once all senders of torques and speeds have closed it; a
sender that lags by more than `WAIT` is not waited for. The oil temperature changes slowly: if it
has a sender of its own, a reading is used from `OIL_DELAY` after its stamp on, and the first one at
once if it arrives with the first bins.
"""

from __future__ import annotations

import bisect
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from .bins import Bin, Bins, Counters, Mean

Array = NDArray[np.float64]

OIL = "oil_temperature"
WAIT = 2.0  # [s] by which a sender may lag behind the newest one
START = 1.5  # [s] of bins that wait for the first messages of other senders
FIRST_OIL = 0.5  # [s] after the first bin within which a temperature is used at once
OIL_DELAY = 5.0  # [s] from the stamp of a temperature to its use


@dataclass
class _Shafts:
    """A sender of torques and speeds."""

    bins: Bins
    closed: dict[int, dict[str, Mean]] = field(default_factory=dict)
    """Bins that are not used yet, by number."""


@dataclass
class _Oil:
    """Temperatures of a separate sender, in the order of their stamps."""

    read: list[tuple[float, float]] = field(default_factory=list)

    def add(self, time: Array, values: Array) -> None:
        for stamp, value in zip(time.tolist(), values.tolist(), strict=True):
            bisect.insort(self.read, (stamp, value))

    def at(self, time: float, first: float) -> float | None:
        """Last reading up to a time; if there is none, the earliest one up to `first`."""
        place = bisect.bisect_right(self.read, (time, math.inf))
        if place:
            del self.read[: place - 1]  # times only grow
            return self.read[0][1]
        return self.read[0][1] if self.read and self.read[0][0] <= first else None


class Merge:
    """Sorts the readings of several senders into common bins.

    Args:
        length: length of a bin [s].
        noise: standard deviation of one reading, by channel; smaller deviations are no outliers.
    """

    def __init__(self, length: float, noise: Mapping[str, float]) -> None:
        self.length, self.counters = length, Counters()
        self._noise = noise
        self._shafts: dict[str, _Shafts] = {}
        self._oil: dict[str, _Oil] = {}
        self._first = 0.0  # [s] start of the first bin that is used
        self._used: int | None = None  # number below which all bins are used

    def add(self, time: Array, columns: Mapping[str, Array], sender: str) -> Iterator[Bin]:
        """Add readings of a sender in the order of their arrival.

        Args:
            time: stamps [s], (n,).
            columns: readings in SI by channel, (n,) each; NaN where a reading is missing.
            sender: name of the sender.

        Returns:
            The bins that are complete, in order. Bins without torques and speeds are omitted.
        """
        if sender not in self._shafts and set(columns) == {OIL}:
            self._warm(np.asarray(time, float), np.asarray(columns[OIL], float), sender)
            return
        own = self._shafts.get(sender)
        if own is None:
            own = self._shafts[sender] = _Shafts(Bins(self.length, self._noise, self.counters))
        own.closed |= {one.number: one.means for one in own.bins.add(time, columns)}
        yield from self._release(self._complete())

    def finish(self) -> Iterator[Bin]:
        """Close the open bins, at the end of a recording.

        Returns:
            The last bins.
        """
        for own in self._shafts.values():
            own.closed |= {one.number: one.means for one in own.bins.finish()}
        last = max((number for own in self._shafts.values() for number in own.closed), default=None)
        yield from self._release(None if last is None else last + 1)

    def _warm(self, time: Array, values: Array, sender: str) -> None:
        there = np.isfinite(time) & np.isfinite(values)
        self.counters.missing += int(np.sum(~there))
        self.counters.used += int(np.sum(there))
        self._oil.setdefault(sender, _Oil()).add(time[there], values[there])

    def _complete(self) -> int | None:
        """Number below which every sender that is waited for has closed its bins."""
        opened = [own.bins.opened for own in self._shafts.values()]
        known = [number for number in opened if number is not None]
        if not known:
            return None
        awaited = max(known) - math.ceil(WAIT / self.length)
        until = min(number for number in known if number >= awaited)
        if self._used is not None:
            return until
        waiting = [number for own in self._shafts.values() for number in own.closed]
        first = min([*known, *waiting])
        return until if until >= first + math.ceil(START / self.length) else None

    def _release(self, until: int | None) -> Iterator[Bin]:
        """Bins below a number."""
        if until is None:
            return
        found = self._united(until)
        if self._used is None and found:
            self._first = min(found) * self.length
        self._used = until if self._used is None else max(until, self._used)
        for number in sorted(found):
            means = found[number]
            oil = self._oil_at(number * self.length)
            yield Bin(number, means if oil is None or OIL in means else means | {OIL: oil})

    def _united(self, until: int) -> dict[int, dict[str, Mean]]:
        """Means of the bins below a number; for a channel of two senders, those of the first."""
        found: dict[int, dict[str, Mean]] = {}
        for name in sorted(self._shafts):
            closed = self._shafts[name].closed
            for number in [number for number in closed if number < until]:
                for channel, mean in closed.pop(number).items():
                    if self._used is not None and number < self._used:
                        self.counters.late += mean.readings
                    elif channel in found.setdefault(number, {}):
                        self.counters.doubled += mean.readings
                    else:
                        found[number][channel] = mean
                        continue
                    self.counters.used -= mean.readings
        return found

    def _oil_at(self, time: float) -> Mean | None:
        """Temperature of a separate sender for a bin that begins at `time`."""
        for name in sorted(self._oil):
            value = self._oil[name].at(time - OIL_DELAY, self._first + FIRST_OIL)
            if value is not None:
                return Mean(value, 1, math.nan, math.nan)
        return None
