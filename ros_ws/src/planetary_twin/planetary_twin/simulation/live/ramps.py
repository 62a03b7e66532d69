"""Quantities that change linearly with simulated time."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

LONGEST_RAMP = 3600.0  # [s]


class Ramp(NamedTuple):
    """A linear change of one quantity."""

    begin: float  # [s]
    end: float  # [s]
    first: float
    last: float

    def at(self, time: float) -> float:
        """Return the value at simulated `time` [s], which must not be before the start."""
        if time >= self.end:
            return self.last
        return self.first + (self.last - self.first) * (time - self.begin) / (
            self.end - self.begin
        )


class Ramps:
    """The ramps in progress, by name of the quantity. Setting a quantity ends its ramp."""

    def __init__(self) -> None:
        self._ramps: dict[str, Ramp] = {}

    def start(
        self, time: float, duration: float, first: Mapping[str, float], last: Mapping[str, float]
    ) -> None:
        """Start ramps from `first` to `last` values at `time` [s], with a `duration` [s]."""
        for name, value in last.items():
            self._ramps[name] = Ramp(time, time + duration, first[name], value)

    def leave(self, names: Mapping[str, float]) -> None:
        """End the ramps of the quantities `names`."""
        for name in names:
            self._ramps.pop(name, None)

    def clear(self) -> None:
        """End all ramps."""
        self._ramps.clear()

    def values(self, time: float) -> dict[str, float]:
        """Return the values at `time` [s]; a ramp that has ended is included once more."""
        values = {name: ramp.at(time) for name, ramp in self._ramps.items()}
        self._ramps = {name: ramp for name, ramp in self._ramps.items() if time < ramp.end}
        return values
