"""Judges the readings of many gearboxes by the checks of a follower, see `following.checks`."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ..following.channels.all import OIL, TORQUES
from ..following.checks.checks import Checks
from ..following.checks.contradictions import Contradictions
from ..following.checks.load_remarks import LoadRemarks
from ..following.checks.power_check import IMPOSSIBLE, balance, wrong_torques
from ..following.checks.reading_check import ReadingCheck
from ..following.loss_map import LossMap
from ..following.sensors import Sensors, inertia_between
from ..following.train import followed_train
from ..scene import Scene

Array = NDArray[np.float64]

TOGETHER = 10, 640  # rows that are compared together, first and at most


class FleetCheck:
    """Judges the rows of many gearboxes in the order of time."""

    def __init__(
        self, scene: Scene, table: LossMap, sensors: Sensors, period: float, count: int
    ) -> None:
        self.faults: dict[int, str] = {}
        """Channel, value and correction by index of a gearbox whose readings contradict the scene,
        and did so in the last rows that were compared."""
        self._train, self._table = followed_train(scene), table
        self._inertia = inertia_between(sensors, self._train)
        self._readings = ReadingCheck(self._train, sensors, count, math.inf)
        contradictions = Contradictions(self._train, table, sensors, period)
        self._checks = Checks(contradictions, count, TOGETHER)
        self._load = LoadRemarks(scene.operating_point, self._train, period, count)
        self._torques = np.full((2, count), np.nan)  # the last ones that belonged together
        self._number = 0

    def judge(self, time: float, row: dict[str, Array]) -> dict[str, Array]:
        """Compare a row, (n,) each in SI, at a time [s]; return it without impossible readings."""
        self._number += 1
        columns = {name: values[None] for name, values in row.items()}
        judged = self._readings.judge(np.array([time]), columns, "rows")
        kept = {name: values[0] for name, values in judged.items()}
        self._load.add(time, kept)
        if self._checks.add(time, kept):
            self._note_faults()
        return kept

    def leave_out_torques(
        self, time: float, row: dict[str, Array], acceleration: Array, oil: Array
    ) -> None:
        """Remove torques of a row that do not belong together, at accelerations [rad/s^2]."""
        torques, speed = (row[TORQUES[0]], row[TORQUES[1]]), row["input_speed"]
        found = balance(self._train, torques, speed, self._inertia * acceleration)
        loss = np.full(len(speed), np.nan)
        if (doubtful := found.doubtful).any():
            oil = np.where(np.isfinite(row[OIL]), row[OIL], oil)
            loss[doubtful] = self._table(torques[0][doubtful], speed[doubtful], oil[doubtful]).total
        impossible = found.impossible(loss)
        sound = np.isfinite(found.lost) & ~impossible
        wrong = wrong_torques(self._train, torques, (self._torques[0], self._torques[1]))
        self._torques = np.where(sound, torques, self._torques)
        for name, which in zip(TORQUES, wrong, strict=True):
            for n in np.flatnonzero(which & impossible):
                number, value = np.array([self._number]), row[name][[n]]
                left_out = self._readings.left_out[n]
                left_out.add(name, IMPOSSIBLE, np.array([time]), value, number)
                row[name][n] = math.nan

    def finish(self) -> None:
        """Compare the last rows, at the end of a table."""
        if self._checks.check():
            self._note_faults()

    def remarks(self, gearbox: int) -> Iterator[str]:
        """A line for each channel of a gearbox and reason, and for torques and speeds."""
        yield from self._readings.left_out[gearbox].remarks()
        yield from self._load.remarks(gearbox)

    def _note_faults(self) -> None:
        """Note the present contradictions."""
        self.faults = self._checks.present | self._readings.refusals()
