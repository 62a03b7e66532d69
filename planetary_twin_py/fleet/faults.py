"""Recognises wrong units and signs in the readings of each gearbox, see `following.contradictions`.

The readings of some rows are compared together: first of a few, so that a fault is named soon, then
of ever more, which costs less.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ..following.contradictions import CHANNELS, Contradictions, Rows
from ..following.loss_map import loss_map
from ..following.plausibility import beyond, ranges_of
from ..following.reading_check import impossible_text
from ..following.sensors import Sensors
from ..following.train import followed_train
from ..following.unit_remarks import FEWEST, TURNING, unit_remarks
from ..scene import Scene

Array = NDArray[np.float64]

FIRST, MOST = 10, 640  # rows that are compared together


class Faults:
    """Compares the readings of many gearboxes with the scene.

    Args:
        scene: scene of the type, with one input.
        sensors: accuracy of the torque sensors.
        period: time between two readings [s].
        count: number of gearboxes.
    """

    def __init__(self, scene: Scene, sensors: Sensors, period: float, count: int) -> None:
        self.lines: dict[int, str] = {}
        """Channel, value and correction by index of a gearbox whose readings contradict the scene.
        """
        train = followed_train(scene)
        self._contradictions = Contradictions(train, loss_map(scene), sensors, period)
        self._ranges = ranges_of(train)
        self._point = scene.operating_point
        self._torque = np.zeros(count)  # [N m] largest magnitude while turning
        self._speeds = np.zeros(count)  # [rad/s] sum of magnitudes while turning
        self._turning = np.zeros(count, dtype=np.int64)  # rows
        self._count, self._together = count, FIRST
        self._times: list[float] = []
        self._rows: list[Mapping[str, Array]] = []

    def add(self, time: float, row: Mapping[str, Array]) -> None:
        """Add one reading of every gearbox.

        Args:
            time: time of the readings [s].
            row: readings by channel in SI, (n,) each; NaN where a reading is missing.
        """
        self._times.append(time)
        self._rows.append({name: values.copy() for name, values in row.items()})
        if len(self._times) >= self._together:
            self.check()
            self._together = min(4 * self._together, MOST)

    def check(self) -> None:
        """Check the readings since the last check."""
        if not self._times:
            return
        time, missing = np.array(self._times), np.full(len(self._times), np.nan)
        columns = {name: np.array([row[name] for row in self._rows]) for name in self._rows[0]}
        self._times.clear()
        self._rows.clear()
        self._note_sizes(columns)
        for n in range(self._count):
            if n in self.lines:
                continue
            own = {name: values[:, n] for name, values in columns.items()}
            rows = Rows(time, {name: own.get(name, missing) for name in CHANNELS})
            lines = [
                *map(self._impossible, own, own.values()),
                *self._contradictions.shown_by(rows).values(),
            ]
            if line := next(filter(None, lines), ""):
                self.lines[n] = line

    def remarks(self, gearbox: int) -> tuple[str, ...]:
        """Lines that ask for a unit, see `following.unit_remarks`.

        Args:
            gearbox: index of the gearbox.
        """
        turning = int(self._turning[gearbox])
        if turning < FEWEST:
            return ()
        speed = float(self._speeds[gearbox]) / turning
        return tuple(unit_remarks(self._point, float(self._torque[gearbox]), speed))

    def _impossible(self, name: str, values: Array) -> str:
        """Line on a channel most of whose readings are beyond the limits of the scene."""
        known, allowed = values[np.isfinite(values)], self._ranges[name]
        wrong = beyond(known, allowed)
        if 2 * wrong.sum() <= len(known):
            return ""
        return impossible_text(name, allowed, known[wrong], len(known))

    def _note_sizes(self, columns: Mapping[str, Array]) -> None:
        """Largest torques and mean speeds while the gearboxes turn."""
        speed, torque = np.abs(columns["input_speed"]), np.abs(columns["input_torque"])
        turning = speed > TURNING * abs(self._point.input_speed)  # false without a speed
        self._turning += turning.sum(axis=0)
        self._speeds += np.where(turning, speed, 0.0).sum(axis=0)
        largest = np.where(turning & np.isfinite(torque), torque, 0.0).max(axis=0)
        self._torque = np.maximum(self._torque, largest)
