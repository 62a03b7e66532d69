"""Puts readings of a sender in order of their stamps and averages them over bins of equal length.

A reading belongs to the bin of its stamp. The first reading, in the order of arrival, whose stamp
is later than the end of a bin by `LAG` closes the bin. Readings that arrive later for this bin are
counted and not used. So the bins depend on the order of arrival only: not on the clock of the
follower, and not on how the readings are split into blocks.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..channels.all import CHANNELS
from ..channels.block_tables import AHEAD

Array = NDArray[np.float64]

LAG = 0.2  # [s] by which stamps may be out of order
OUTLIER = 5.0  # robust standard deviations above which a reading is an outlier
NORMAL = 1.4826  # standard deviation of a normal distribution over its median absolute deviation
UNUSED = 0.05  # share of the readings that are not used, above which there is a remark
ENOUGH = 5  # readings of a bin below which outliers are not searched


class Mean(NamedTuple):
    """Regression line through the readings of a channel in one bin."""

    value: float
    """Value of the line at the middle of the bin; the mean with fewer than three readings, or if
    all are on one side of the middle."""
    readings: int
    """Number of readings."""
    slope: float
    """Slope of the line [1/s]; NaN where the value is a mean."""
    scatter: float
    """Standard deviation about that line; NaN below four readings, and without a line."""


class Bin(NamedTuple):
    """Means over one bin."""

    number: int
    """The bin covers `number` to `number` + 1 times its length."""
    means: dict[str, Mean]
    """Means by channel, for channels that have readings."""

    def speed(self, ratio: float) -> tuple[Mean | None, float]:
        """Mean of a measured speed, if any, and the factor that refers it to the input."""
        if "input_speed" in self.means:
            return self.means["input_speed"], 1.0
        return self.means.get("output_speed"), 1.0 / ratio


@dataclass
class Counters:
    """Numbers of readings that were not used, by reason."""

    used: int = 0
    late: int = 0
    """Readings that arrived after their bin was closed."""
    doubled: int = 0
    """Readings with the stamp of another reading of the channel."""
    missing: int = 0
    """Readings that are not finite."""
    outlying: int = 0
    """Readings further from the median of their bin than 5 robust standard deviations."""
    ahead: int = 0
    """Readings with a single stamp far in the future."""
    implausible: int = 0
    """Readings that no machine can have, see `reading_check` and `power_check`."""

    def remarks(self) -> Iterator[str]:
        """A line for each reason for which a large share of the readings was not used.

        Missing readings do not count, because a channel may be slower than others of its table.
        """
        refused = {
            "came too late": self.late,
            "have the stamp of another": self.doubled,
            "are far from the median of their bin": self.outlying,
            "have a stamp far ahead of their neighbours": self.ahead,
        }
        total = self.used + sum(refused.values())
        for reason, count in refused.items():
            if count > UNUSED * total:
                yield f"{count} of {total} values {reason} and are not used"


@dataclass
class _Pending:
    """Readings of bins that are open."""

    parts: list[tuple[Array, Array]] = field(default_factory=list)

    def join(self) -> tuple[Array, Array]:
        """Return times and values as one array each."""
        if not self.parts:
            return np.empty(0), np.empty(0)
        time, value = (np.concatenate(pieces) for pieces in zip(*self.parts, strict=True))
        return time, value


class Bins:
    """Sorts readings into bins.

    Args:
        length: length of a bin [s].
        noise: standard deviation of one reading, by channel; smaller deviations are no outliers.
        counters: counters of readings that are not used; None: new ones.
    """

    def __init__(
        self, length: float, noise: Mapping[str, float], counters: Counters | None = None
    ) -> None:
        self.length = length
        self.counters = Counters() if counters is None else counters
        self._noise = noise
        self._pending = {name: _Pending() for name in CHANNELS}
        self._latest_stamp = -np.inf
        self._first_open: int | None = None  # number of that bin
        self._withheld: tuple[Array, dict[str, Array]] | None = (
            None  # the last row, if its stamp may be wrong
        )

    @property
    def opened(self) -> int | None:
        """Number of the first bin that is still open; None before the first reading."""
        return self._first_open

    def add(self, time: Array, columns: Mapping[str, Array]) -> Iterator[Bin]:
        """Add readings (n,) in the order of their arrival; return the bins that they close."""
        time, rows = self._without_jumps(time, columns)
        if len(time):
            self._sort(time, rows)
            yield from self._close_bins(closed_by(self._latest_stamp, self.length))

    def finish(self) -> Iterator[Bin]:
        """Close the open bins, at the end of a recording."""
        if self._withheld is not None:
            self.counters.ahead += 1
            self._withheld = None
        if np.isfinite(self._latest_stamp):
            yield from self._close_bins(slot_of(self._latest_stamp, self.length) + 1)

    def _without_jumps(
        self, time: Array, columns: Mapping[str, Array]
    ) -> tuple[Array, dict[str, Array]]:
        """Remove rows with a single stamp far ahead; withhold a last row that may be one."""
        time = np.asarray(time, dtype=float)
        rows = {name: np.asarray(values, dtype=float) for name, values in columns.items()}
        if self._withheld is not None:
            time, rows = _concatenate_rows(self._withheld, (time, rows))
            self._withheld = None
        has_stamp = np.isfinite(time)
        if not has_stamp.all():
            self.counters.missing += int(np.sum(~has_stamp)) * len(rows)
            time, rows = _select_rows(has_stamp, time, rows)
        if not len(time):
            return time, rows
        latest_before = np.concatenate([[self._latest_stamp], np.maximum.accumulate(time)[:-1]])
        jumps = np.flatnonzero((time > latest_before + AHEAD) & np.isfinite(latest_before))
        wrong = np.zeros(len(time), dtype=bool)
        for n in jumps:
            latest = np.max(time[:n][~wrong[:n]], initial=self._latest_stamp)
            if time[n] <= latest + AHEAD:
                continue
            if n + 1 == len(time):
                self._withheld = _select_rows(np.arange(len(time)) == n, time, rows)
                wrong[n] = True
            elif time[n + 1] < time[n] - AHEAD:
                self.counters.ahead += 1
                wrong[n] = True
        return _select_rows(~wrong, time, rows) if wrong.any() else (time, rows)

    def _sort(self, time: Array, rows: dict[str, Array]) -> None:
        """Keep the readings of bins that were open as each of them arrived."""
        number = np.floor(time / self.length + 1e-9)
        latest = np.maximum.accumulate(time)
        latest_before = np.concatenate(
            [[self._latest_stamp], np.maximum(latest[:-1], self._latest_stamp)]
        )
        first_open = np.floor((latest_before - LAG) / self.length + 1e-9)
        in_time = number >= first_open
        self._latest_stamp = max(self._latest_stamp, float(latest[-1]))
        if self._first_open is None:
            self._first_open = int(number[in_time].min())
        for name, values in rows.items():
            finite = np.isfinite(values)
            self.counters.missing += int(np.sum(~finite))
            self.counters.late += int(np.sum(finite & ~in_time))
            accepted = finite & in_time
            if accepted.any():
                self._pending[name].parts.append((time[accepted], values[accepted]))

    def _close_bins(self, until: int) -> Iterator[Bin]:
        """Close the bins below number `until`, and yield their means."""
        if self._first_open is None or until <= self._first_open:
            return
        means: dict[int, dict[str, Mean]] = {}
        for name, pending in self._pending.items():
            times, values = pending.join()
            bin_numbers = np.floor(times / self.length + 1e-9).astype(np.int64)
            ready = bin_numbers < until
            order = np.argsort(times[ready], kind="stable")
            time, value = times[ready][order], values[ready][order]
            ready_numbers = bin_numbers[ready][order]
            if len(time):
                cuts = np.flatnonzero(np.diff(ready_numbers)) + 1
                parts = zip(np.split(time, cuts), np.split(value, cuts), strict=True)
                for number, (bin_time, bin_values) in zip(
                    ready_numbers[np.r_[0, cuts]], parts, strict=True
                ):
                    middle = (int(number) + 0.5) * self.length
                    means.setdefault(int(number), {})[name] = self._mean(
                        name, middle, bin_time, bin_values
                    )
            pending.parts = [(times[~ready], values[~ready])]
        self._first_open = until
        for number in sorted(means):
            yield Bin(number, means[number])

    def _mean(self, name: str, middle: float, time: Array, value: Array) -> Mean:
        """Mean of the readings of a bin around `middle`, in the order of their stamps."""
        distinct = time[1:] > time[:-1]
        if not distinct.all():
            self.counters.doubled += int(np.sum(~distinct))
            selected = np.concatenate([[True], distinct])
            time, value = time[selected], value[selected]
        if len(value) >= ENOUGH:
            deviation = np.abs(value - _median(value))
            robust_sd = max(self._noise.get(name, 0.0), NORMAL * _median(deviation))
            accepted = deviation <= OUTLIER * robust_sd if robust_sd > 0.0 else deviation == 0.0
            if not accepted.all():
                self.counters.outlying += int(np.sum(~accepted))
                time, value = time[accepted], value[accepted]
        n = len(value)
        self.counters.used += n
        mean, mean_time = float(value.sum()) / n, float(time.sum()) / n
        # Beyond the readings, the error of a line through a few of them exceeds their noise.
        if n < 3 or not time[0] <= middle <= time[-1]:
            return Mean(mean, n, np.nan, np.nan)
        time_offset = time - mean_time
        slope = float(time_offset @ value / (time_offset @ time_offset))
        residual = value - mean - slope * time_offset
        # A line, because the mean of incomplete readings is biased while the torque changes.
        mean += slope * (middle - mean_time)
        return Mean(
            mean, n, slope, float(np.sqrt(residual @ residual / (n - 2))) if n > 3 else np.nan
        )


def _median(values: Array) -> float:
    """Median of a few values, at a tenth of the cost of that of numpy."""
    ordered = np.sort(values)
    half = len(ordered) // 2
    if len(ordered) % 2:
        return float(ordered[half])
    return 0.5 * float(ordered[half - 1] + ordered[half])


def slot_of(time: float, length: float) -> int:
    """Number of the bin of a time, for bins of a length [s]."""
    return int(np.floor(time / length + 1e-9))


def closed_by(stamp: float, length: float) -> int:
    """Number of the first bin of a length [s] that stays open after a stamp [s]."""
    return slot_of(stamp - LAG, length)


def _concatenate_rows(
    first: tuple[Array, dict[str, Array]], second: tuple[Array, dict[str, Array]]
) -> tuple[Array, dict[str, Array]]:
    """Concatenate the rows of two tables, with NaN in columns that one of them lacks."""
    names = list(dict.fromkeys([*first[1], *second[1]]))
    parts = [
        [rows.get(name, np.full(len(time), np.nan)) for time, rows in (first, second)]
        for name in names
    ]
    columns = {name: np.concatenate(part) for name, part in zip(names, parts, strict=True)}
    return np.concatenate([first[0], second[0]]), columns


def _select_rows(
    rows: NDArray[np.bool_], time: Array, columns: dict[str, Array]
) -> tuple[Array, dict[str, Array]]:
    return time[rows], {name: values[rows] for name, values in columns.items()}
