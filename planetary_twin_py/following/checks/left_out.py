"""Counts and names readings that are left out."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrival.bins import Mean
from ..channels.all import CHANNELS

Array = NDArray[np.float64]
NAMED = 3  # spans of a channel and reason that are named one by one


@dataclass(frozen=True)
class Span:
    """Successive readings that are left out."""

    begin: float
    """[s]"""
    end: float
    """[s]"""
    low: float
    high: float
    places: tuple[int, int]
    """First and last row, or bin."""
    count: int
    """Number of readings."""
    rows: bool = True
    """Whether the places are rows."""

    @classmethod
    def of(cls, time: Array, values: Array, rows: NDArray[Any]) -> Span:
        """The span of some readings, (n,) each, in the order of their arrival."""
        places = int(rows[0]), int(rows[-1])
        low, high = float(values.min()), float(values.max())
        return cls(float(time[0]), float(time[-1]), low, high, places, len(rows))

    def joined(self, new: Span) -> Span:
        """This span and a later one."""
        return replace(
            self, end=new.end, low=min(self.low, new.low), high=max(self.high, new.high),
            places=(self.places[0], new.places[1]), count=self.count + new.count,
        )  # fmt: skip

    def text(self, unit: str) -> str:
        """Values in their unit, times and rows."""
        values = f"{self.low:.6g}" + (f" to {self.high:.6g}" if self.high > self.low else "")
        if self.end == self.begin:
            time = f"at {self.begin:.2f} s"
        else:
            time = f"from {self.begin:.2f} to {self.end:.2f} s"
        first, last = self.places
        rows = f", row {first}" if first == last else f", rows {first} to {last}"
        readings = f"{self.count} {'reading' if self.count == 1 else 'readings'}"
        return f"{f'{values} {unit}'.rstrip()} {time} ({readings}{rows if self.rows else ''})"


@dataclass
class LeftOut:
    """Readings that are left out, by channel and reason."""

    count: int = 0
    """Number of all of them."""
    _spans: dict[tuple[str, str], list[Span]] = field(default_factory=dict)

    def add(self, channel: str, reason: str, time: Array, values: Array, rows: Array) -> None:
        """Add readings of a channel in SI, (n,), with stamps [s] and increasing numbers."""
        for part in np.split(np.arange(len(rows)), np.flatnonzero(np.diff(rows) > 1) + 1):
            self.add_span(channel, reason, Span.of(time[part], values[part], rows[part]))

    def add_bin(self, channel: str, reason: str, number: int, mean: Mean, period: float) -> None:
        """Add the readings of a bin."""
        begin, value, places = number * period, mean.value, (number, number)
        span = Span(begin, begin + period, value, value, places, mean.readings, rows=False)
        self.add_span(channel, reason, span)

    def add_span(self, channel: str, reason: str, new: Span) -> None:
        """Add successive readings of a channel; spans beyond `NAMED` become one."""
        self.count += new.count
        spans = self._spans.setdefault((channel, reason), [])
        last = spans[-1] if spans else None
        if last is None or (new.places[0] > last.places[1] + 1 and len(spans) <= NAMED):
            spans.append(new)
        else:
            spans[-1] = last.joined(new)

    def remarks(self, treated: str = "left out") -> Iterator[str]:
        """A line for each channel and reason; `treated` says what was done with the readings."""
        for (channel, reason), spans in self._spans.items():
            unit = CHANNELS.get(channel, "")
            named = "; ".join(span.text(unit) for span in spans[:NAMED])
            more = f"; and others, {spans[NAMED].text(unit)}" if len(spans) > NAMED else ""
            yield f"{channel}: {treated}, because {reason}: {named}{more}"
