"""Quantities that change linearly with simulated time."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

LONGEST_RAMP = 3600.0  # [s]


class Ramp(NamedTuple):
    """A quantity on its way."""

    begin: float  # [s]
    end: float  # [s]
    first: float
    last: float

    def at(self, time: float) -> float:
        """Its value at a simulated time [s] not before the beginning."""
        if time >= self.end:
            return self.last
        return self.first + (self.last - self.first) * (time - self.begin) / (
            self.end - self.begin
        )


class Ramps:
    """Those under way, by name. A quantity that is set meanwhile leaves its ramp."""

    def __init__(self) -> None:
        self._ramps: dict[str, Ramp] = {}

    def start(
        self, time: float, duration: float, first: Mapping[str, float], last: Mapping[str, float]
    ) -> None:
        """Let quantities go from their `first` to their `last` values from `time` [s] on."""
        for name, value in last.items():
            self._ramps[name] = Ramp(time, time + duration, first[name], value)

    def leave(self, names: Mapping[str, float]) -> None:
        """Take quantities off their ramps."""
        for name in names:
            self._ramps.pop(name, None)

    def clear(self) -> None:
        """Take all off."""
        self._ramps.clear()

    def values(self, time: float) -> dict[str, float]:
        """Values of those under way; what has arrived is told once more and then no longer."""
        values = {name: ramp.at(time) for name, ramp in self._ramps.items()}
        self._ramps = {name: ramp for name, ramp in self._ramps.items() if time < ramp.end}
        return values
