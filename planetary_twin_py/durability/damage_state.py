"""Damage of one gearbox so far: what is carried from one reading, run or program to the next."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..text.finite import finite
from .parts import parts_of
from .sums import Sums

HOUR = 3600.0  # [s]
WARNING, ERROR = 0.8, 1.0  # of the damage of a part


class Replacement(NamedTuple):
    """A part that was replaced."""

    part: str
    """Its name."""
    time: float
    """Stamp of the last reading before, or simulated time [s]; NaN if there is none."""
    hours: float
    """Hours that were counted until then, of the whole gearbox [h]."""
    damage: float
    """Miner sum of the part that was taken out."""


@dataclass
class Times:
    """Times by what is known of them."""

    counted: Sums = field(default_factory=Sums.zero)
    """[s] with readings, or simulated."""
    unknown: Sums = field(default_factory=Sums.zero)
    """[s] of gaps between readings: their damage is not known."""
    outside: Sums = field(default_factory=Sums.zero)
    """[s] with readings that the map does not cover."""


@dataclass
class Last:
    """The last readings."""

    time: float = math.nan
    """Stamp of the last reading that was used [s]; NaN before the first."""
    speed: float = math.nan
    """Speed of the input [rad/s]."""
    speed_time: float = math.nan
    """Its stamp [s]."""
    oil_temperature: float = math.nan
    """[K]."""
    steps: tuple[float, ...] = ()
    """Times between the last readings [s], the newest last."""


@dataclass
class Readings:
    """Numbers of readings."""

    counted: int = 0
    """In the sums."""
    outside: int = 0
    """Outside the map."""
    first_outside: float = math.nan
    """Stamp of the first of them [s]."""
    no_oil_temperature: int = 0
    """Without oil temperature, for which the last one was taken."""


@dataclass
class OilTemperature:
    """Oil temperature over the time that was counted."""

    integral: Sums = field(default_factory=Sums.zero)
    """Of the temperature over that time [K s]."""
    highest: float = math.nan
    """[K]."""


@dataclass
class DamageState:
    """Damage of the parts of a gearbox.

    Args:
        parts: names of the parts.
    """

    parts: tuple[str, ...]
    damage: Sums = field(default_factory=Sums.zero)
    """Miner sums, (parts,)."""
    passages: list[int] = field(default_factory=list)
    """Passages of teeth through a mesh, of all teeth of a part together; 0 for bearings."""
    times: Times = field(default_factory=Times)
    turns: Sums = field(default_factory=lambda: Sums.zero(2))
    """Turns of the input, in either direction, under a positive and a negative torque, (2,)."""
    readings: Readings = field(default_factory=Readings)
    last: Last = field(default_factory=Last)
    oil: OilTemperature = field(default_factory=OilTemperature)
    teeth: dict[str, Sums] = field(default_factory=dict)
    """Miner sums of the teeth of a flank or root less that of the part, (teeth,), where teeth are
    counted by themselves: what is counted for the part alone is the same for all of them."""
    turning: dict[str, tuple[float, ...]] = field(default_factory=dict)
    """Turning points of the torque that are in no closed cycle yet [N m], by shaft."""
    replaced: list[Replacement] = field(default_factory=list)
    temperatures: dict[str, float] = field(default_factory=dict)
    """Last temperatures of a simulated gearbox where they are states [K], by part."""

    def __post_init__(self) -> None:
        if not self.damage.sum.ndim:
            self.damage = Sums.zero(len(self.parts))
        self.passages = self.passages or [0] * len(self.parts)

    @property
    def sums(self) -> NDArray[np.float64]:
        """Miner sums of the parts, (parts,)."""
        return self.damage.total

    def seconds(self, name: str) -> float:
        """One of the times, "counted", "unknown" or "outside" [s]."""
        return float(getattr(self.times, name).total)

    @property
    def hours(self) -> float:
        """Time that was counted [h]."""
        return float(self.times.counted.total) / HOUR

    @property
    def hours_of_parts(self) -> NDArray[np.float64]:
        """Counted time since each part is in the gearbox [h], (parts,)."""
        since = dict.fromkeys(self.parts, 0.0) | {one.part: one.hours for one in self.replaced}
        return self.hours - np.array([since[part] for part in self.parts])

    @property
    def rates(self) -> NDArray[np.float64]:
        """Mean rates of damage since each part is in the gearbox [1/h], (parts,); NaN before."""
        hours = self.hours_of_parts
        return np.divide(self.sums, hours, np.full(len(hours), math.nan), where=hours > 0.0)

    @property
    def remaining_hours(self) -> NDArray[np.float64]:
        """Hours until a Miner sum of 1 at the mean rate so far [h], (parts,); 0 from 1 on.

        Infinite for a part without damage, NaN before anything is counted.
        """
        with np.errstate(divide="ignore"):
            return np.asarray(np.maximum(1.0 - self.sums, 0.0) / self.rates)

    @property
    def worst(self) -> str:
        """Part with the largest Miner sum; empty before there is damage."""
        place = int(np.argmax(self.sums))
        return self.parts[place] if self.sums[place] > 0.0 else ""

    @property
    def mean_oil_temperature(self) -> float:
        """Mean oil temperature over the counted time [K]; NaN before."""
        time = float(self.times.counted.total)
        return float(self.oil.integral.total) / time if time > 0.0 else math.nan

    @property
    def warnings(self) -> tuple[str, ...]:
        """Lines on parts whose damage is at least 0.8, those of at least 1 first."""
        worn, near = list(self.above(ERROR)), list(self.above(WARNING))
        near = [part for part in near if part not in worn]
        lines = []
        for limit, parts in ((ERROR, worn), (WARNING, near)):
            if parts:
                each = ", ".join(f"{part} {self.of(part):.3g}" for part in parts)
                lines.append(f"damage of {limit:g} or more: {each}")
        return tuple(lines)

    def of_teeth(self, part: str, teeth: int) -> NDArray[np.float64]:
        """Miner sums of the teeth of a part; its own where teeth are not counted by themselves.

        Args:
            part: a flank or root.
            teeth: number of its teeth.
        """
        apart = self.teeth.get(part)
        return np.full(teeth, self.of(part)) + (0.0 if apart is None else apart.total)

    def of(self, part: str) -> float:
        """Miner sum of a part."""
        return float(self.sums[self.parts.index(part)])

    def above(self, limit: float) -> Sequence[str]:
        """Parts whose Miner sum is at least a limit, the worst first."""
        sums = self.sums
        return [self.parts[n] for n in np.argsort(-sums, kind="stable") if sums[n] >= limit]

    def figures(self) -> dict[str, Any]:
        """The damage for JSON; None in place of what is unknown."""
        columns = {
            "damage": self.sums, "rate": self.rates, "remaining_hours": self.remaining_hours,
        }  # fmt: skip
        readings = {name: finite(value) for name, value in vars(self.readings).items()}
        return {
            "hours": self.hours,
            "unknown_hours": float(self.times.unknown.total) / HOUR,
            "outside_hours": float(self.times.outside.total) / HOUR,
            "readings": readings,
            "mean_oil_temperature": finite(self.mean_oil_temperature),
            "highest_oil_temperature": finite(self.oil.highest),
            "worst": self.worst or None,
            "parts": {
                part: {name: finite(float(values[n])) for name, values in columns.items()}
                | {"passages": self.passages[n]}
                for n, part in enumerate(self.parts)
            },
            "replaced": [
                {name: finite(value) for name, value in entry._asdict().items()}
                for entry in self.replaced
            ],
        }

    def replace_part(self, name: str, time: float | None = None) -> tuple[Replacement, ...]:
        """Set the damage of a part to 0, and note that it was replaced.

        Args:
            name: a part, or a gear for its flanks and root.
            time: when [s]; None: at the last reading.

        Returns:
            The entries of the log.

        Raises:
            ValueError: there is no such part.
        """
        at = self.last.time if time is None else time
        entries, sums = [], self.sums
        for part in parts_of(name, self.parts):
            place = self.parts.index(part)
            entries.append(Replacement(part, at, self.hours, float(sums[place])))
            for values in (self.damage.sum, self.damage.compensation):
                values[place] = 0.0
            self.passages[place] = 0
            if part in self.teeth:
                self.teeth[part] = Sums.zero(*self.teeth[part].sum.shape)
            self.turning.pop(part, None)
        self.replaced += entries
        return tuple(entries)
