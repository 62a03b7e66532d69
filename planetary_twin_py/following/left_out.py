"""Counts and names readings that are left out."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from .bins import Mean
from .channels.all import CHANNELS

Array = NDArray[np.float64]
NAMED = 3  # spans of a channel and reason that are named one by one


@dataclass(frozen=True)
class _Span:
    """Successive readings that are left out."""

    begin: float  # [s]
    end: float  # [s]
    low: float
    high: float
    places: tuple[int, int]  # first and last: rows, or bins
    count: int  # of readings
    rows: bool = True  # whether the places are rows

    def text(self, channel: str) -> str:
        unit = CHANNELS[channel]
        values = f"{self.low:.6g}" + (f" to {self.high:.6g}" if self.high > self.low else "")
        time = f"at {self.begin:.2f} s" if self.end == self.begin else (
            f"from {self.begin:.2f} to {self.end:.2f} s"
        )  # fmt: skip
        first, last = self.places
        rows = f", row {first}" if first == last else f", rows {first} to {last}"
        readings = "reading" if self.count == 1 else "readings"
        return f"{values} {unit} {time} ({self.count} {readings}{rows if self.rows else ''})"


@dataclass
class LeftOut:
    """Readings that are left out, by channel and reason."""

    count: int = 0
    """Number of all of them."""
    _spans: dict[tuple[str, str], list[_Span]] = field(default_factory=dict)

    def add(self, channel: str, reason: str, time: Array, values: Array, rows: Array) -> None:
        """Add readings of a channel.

        Args:
            channel: name of the channel.
            reason: why they are left out.
            time: their stamps [s], (n,).
            values: the readings in SI, (n,).
            rows: their numbers in the order of arrival, (n,), increasing.
        """
        for part in np.split(np.arange(len(rows)), np.flatnonzero(np.diff(rows) > 1) + 1):
            self._add(
                (channel, reason),
                _Span(
                    float(time[part[0]]), float(time[part[-1]]),
                    float(values[part].min()), float(values[part].max()),
                    (int(rows[part[0]]), int(rows[part[-1]])), len(part),
                ),
            )  # fmt: skip

    def add_bin(self, channel: str, reason: str, number: int, mean: Mean, period: float) -> None:
        """Add the readings of a bin.

        Args:
            channel: name of the channel.
            reason: why they are left out.
            number: number of the bin.
            mean: the readings.
            period: length of a bin [s].
        """
        begin = number * period
        span = _Span(
            begin, begin + period, mean.value, mean.value, (number, number), mean.readings, False
        )
        self._add((channel, reason), span)

    def _add(self, key: tuple[str, str], new: _Span) -> None:
        """Add a span; those beyond `NAMED` become one."""
        self.count += new.count
        spans = self._spans.setdefault(key, [])
        last = spans[-1] if spans else None
        if last is None or (new.places[0] > last.places[1] + 1 and len(spans) <= NAMED):
            spans.append(new)
            return
        spans[-1] = replace(
            last, end=new.end, low=min(last.low, new.low), high=max(last.high, new.high),
            places=(last.places[0], new.places[1]), count=last.count + new.count,
        )  # fmt: skip

    def remarks(self, treated: str = "left out") -> Iterator[str]:
        """A line for each channel and reason.

        Args:
            treated: what was done with these readings.
        """
        for (channel, reason), spans in self._spans.items():
            named = "; ".join(span.text(channel) for span in spans[:NAMED])
            more = f"; and others, {spans[NAMED].text(channel)}" if len(spans) > NAMED else ""
            yield f"{channel}: {treated}, because {reason}: {named}{more}"
