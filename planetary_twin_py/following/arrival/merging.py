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
        count = bisect.bisect_right(self.read, (time, math.inf))
        if count:
            del self.read[: count - 1]  # times only grow
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
        self._start = 0.0  # [s] start of the first bin that is used
        self._used_until: int | None = None  # number below which all bins are used

    def add(self, time: Array, columns: Mapping[str, Array], sender: str) -> Iterator[Bin]:
        """Add readings, see `CheckedBins.add`; bins without torques and speeds are omitted."""
        if sender not in self._shafts and set(columns) == {OIL}:
            self._add_temperatures(np.asarray(time, float), np.asarray(columns[OIL], float), sender)
            return
        shafts = self._shafts.get(sender)
        if shafts is None:
            shafts = self._shafts[sender] = _Shafts(Bins(self.length, self._noise, self.counters))
        shafts.closed |= {
            time_bin.number: time_bin.means for time_bin in shafts.bins.add(time, columns)
        }
        yield from self._release(self._complete())

    def finish(self) -> Iterator[Bin]:
        """Close the open bins, at the end of a recording."""
        for shafts in self._shafts.values():
            shafts.closed |= {time_bin.number: time_bin.means for time_bin in shafts.bins.finish()}
        last = max(
            (number for shafts in self._shafts.values() for number in shafts.closed), default=None
        )
        yield from self._release(None if last is None else last + 1)

    def _add_temperatures(self, time: Array, values: Array, sender: str) -> None:
        finite = np.isfinite(time) & np.isfinite(values)
        self.counters.missing += int(np.sum(~finite))
        self.counters.used += int(np.sum(finite))
        self._oil.setdefault(sender, _Oil()).add(time[finite], values[finite])

    def _complete(self) -> int | None:
        """Number below which every sender that is waited for has closed its bins."""
        opened = [shafts.bins.opened for shafts in self._shafts.values()]
        open_numbers = [number for number in opened if number is not None]
        if not open_numbers:
            return None
        awaited = max(open_numbers) - math.ceil(WAIT / self.length)
        until = min(number for number in open_numbers if number >= awaited)
        if self._used_until is not None:
            return until
        waiting = [number for shafts in self._shafts.values() for number in shafts.closed]
        first = min([*open_numbers, *waiting])
        return until if until >= first + math.ceil(START / self.length) else None

    def _release(self, until: int | None) -> Iterator[Bin]:
        """Bins below a number."""
        if until is None:
            return
        bins = self._take_bins(until)
        if self._used_until is None and bins:
            self._start = min(bins) * self.length
        self._used_until = until if self._used_until is None else max(until, self._used_until)
        for number in sorted(bins):
            means = bins[number]
            oil = self._oil_at(number * self.length)
            yield Bin(number, means if oil is None or OIL in means else means | {OIL: oil})

    def _take_bins(self, until: int) -> dict[int, dict[str, Mean]]:
        """Means of the bins below a number; for a channel of two senders, those of the first."""
        bins: dict[int, dict[str, Mean]] = {}
        for name in sorted(self._shafts):
            closed = self._shafts[name].closed
            for number in [number for number in closed if number < until]:
                for channel, mean in closed.pop(number).items():
                    if self._used_until is not None and number < self._used_until:
                        self.counters.late += mean.readings
                    elif channel in bins.setdefault(number, {}):
                        self.counters.doubled += mean.readings
                    else:
                        bins[number][channel] = mean
                        continue
                    self.counters.used -= mean.readings
        return bins

    def _oil_at(self, time: float) -> Mean | None:
        """Temperature of a separate sender for a bin that begins at `time`."""
        for name in sorted(self._oil):
            value = self._oil[name].at(time - OIL_DELAY, self._start + FIRST_OIL)
            if value is not None:
                return Mean(value, 1, math.nan, math.nan)
        return None
