"""Values by stamp, with little memory for each: a day of a driven run may have 8.6 million."""

from __future__ import annotations

import math
from array import array
from bisect import bisect_left
from collections.abc import Iterator, Mapping


class CommandsByStamp(Mapping[int, dict[str, float]]):
    """Values by name at each stamp [ns], in a column for each name that occurs."""

    def __init__(self) -> None:
        self._stamps = array("q")
        self._columns: dict[str, array[float]] = {}

    def add(self, stamp: int, values: Mapping[str, float]) -> None:
        """Add the values at a stamp, in place of earlier ones; NaN is no value."""
        place = self._place(stamp)
        if place is None:
            place = bisect_left(self._stamps, stamp)
            self._stamps.insert(place, stamp)
            for column in self._columns.values():
                column.insert(place, math.nan)
        for name in values.keys() - self._columns.keys():
            self._columns[name] = array("d", [math.nan]) * len(self)
        for name, column in self._columns.items():
            column[place] = values.get(name, math.nan)

    def __getitem__(self, stamp: int) -> dict[str, float]:
        place = self._place(stamp)
        if place is None:
            raise KeyError(stamp)
        values = ((name, column[place]) for name, column in self._columns.items())
        return {name: value for name, value in values if not math.isnan(value)}

    def __iter__(self) -> Iterator[int]:
        return iter(self._stamps)

    def __len__(self) -> int:
        return len(self._stamps)

    def _place(self, stamp: int) -> int | None:
        place = bisect_left(self._stamps, stamp)
        found = place < len(self._stamps) and self._stamps[place] == stamp
        return place if found else None
