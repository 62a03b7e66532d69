"""Checks readings for a wrong unit, a wrong sign or exchanged shafts, as long as they arrive.

Readings that contradict the scene as soon as they show a quantity are refused. Later ones are a
remark: a sensor may fail or be connected again at any time.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from .bins import Bin
from .contradictions import CHANNELS, LOADED, MOVING, Contradictions, Rows
from .loss_map import LossMap
from .sensors import Sensors
from .train import FollowedTrain

CHECKED = 5.0  # [s] of readings that are compared together


class InputError(ValueError):
    """Readings that contradict the scene; the message names channel, value and correction."""


@dataclass
class Checks:
    """Compares readings with the scene, in spans in which the train turns or is loaded.

    Args:
        train: gear train of the scene.
        losses: loss torques of the scene.
        sensors: accuracy of the torque sensors.
        length: length of a bin [s].
    """

    train: FollowedTrain
    losses: LossMap
    sensors: Sensors
    length: float
    _rows: list[tuple[float, ...]] = field(default_factory=list)  # time and `CHANNELS`
    _in_order: set[str] = field(default_factory=set)  # comparisons that were in order once
    _later: dict[str, str] = field(default_factory=dict)
    """The first later contradiction of each comparison."""

    def __post_init__(self) -> None:
        self._contradictions = Contradictions(self.train, self.losses, self.sensors, self.length)
        train = self.train
        self._least = (
            MOVING * train.speed, MOVING * train.speed * abs(train.ratio),
            LOADED * train.torque, LOADED * train.torque / abs(train.ratio),
        )  # fmt: skip

    @property
    def agreed(self) -> bool:
        """Whether the torques were in order once."""
        return "torques" in self._in_order

    def add(self, found: Bin) -> None:
        """Add a bin; at the end of a span, check the readings.

        Args:
            found: the bin.

        Raises:
            InputError: a channel has another unit, sign or shaft.
        """
        means, time = found.means, (found.number + 1) * self.length
        values = [means[name].value if name in means else math.nan for name in CHANNELS]
        if any(abs(value) > least for value, least in zip(values, self._least, strict=True)):
            self._rows.append((time, *values))
            if len(self._rows) * self.length >= CHECKED:
                self.check()

    def check(self) -> None:
        """Check what has been read since the last check.

        Raises:
            InputError: see `add`.
        """
        if not self._rows:
            return
        time, *columns = np.array(self._rows).T
        self._rows.clear()
        shown = self._contradictions.shown_by(Rows(time, dict(zip(CHANNELS, columns, strict=True))))
        for name, line in shown.items():
            self._note(name, line, float(time[0]) - self.length)

    def remarks(self) -> Iterator[str]:
        """A line for each comparison that was in order first and is not any more."""
        yield from self._later.values()

    def _note(self, name: str, line: str, begin: float) -> None:
        """Refuse a contradiction, unless the same comparison was in order before."""
        if not line:
            self._in_order.add(name)
        elif name not in self._in_order:
            raise InputError(line)
        else:
            self._later.setdefault(
                name,
                f"readings after {begin:.1f} s contradict the scene, and those before did not: "
                f"{line}",
            )
