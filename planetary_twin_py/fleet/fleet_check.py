"""Leaves out readings of each gearbox that no machine has, see `following.plausibility`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from ..following.left_out import LeftOut
from ..following.loss_map import LossMap
from ..following.plausibility import OIL, beyond, equals_code, leaps, ranges_of
from ..following.power_check import IMPOSSIBLE, balance, wrong_torques
from ..following.reading_check import CODE, TORQUES, limit_text, nominal_values
from ..following.repeats import STUCK, Repeats
from ..following.sensors import Sensors, torque_change
from ..following.train import FollowedTrain

Array = NDArray[np.float64]


class FleetCheck:
    """Judges the rows of many gearboxes in the order of time.

    Args:
        train: gear train of the type.
        table: table of its losses.
        sensors: accuracy of the sensors.
        count: number of gearboxes.
    """

    def __init__(self, train: FollowedTrain, table: LossMap, sensors: Sensors, count: int) -> None:
        self.left_out: dict[int, LeftOut] = {}
        """Readings that are left out, by index of the gearbox."""
        self._train, self._table, self._ranges = train, table, ranges_of(train)
        self._inertia = train.inertia if sensors.inertia is None else sensors.inertia
        nominal = nominal_values(train)
        self._usual = {name: np.full(count, value) for name, value in nominal.items()}
        self._known = {name: np.zeros(count, dtype=bool) for name in nominal}
        self._torques = np.full((2, count), np.nan)
        self._repeats = Repeats(torque_change(sensors, train), train.ratio, count)
        self._number = 0

    def without_codes(self, time: float, row: dict[str, Array]) -> dict[str, Array]:
        """Remove the codes for missing readings from a row.

        Args:
            time: time of the row [s].
            row: readings in SI by channel, (n,) each; changed in place.

        Returns:
            A copy for the comparison with the scene, also without the torques of dead sensors.
        """
        self._number += 1
        for name, values in row.items():
            usual = self._usual[name]
            usual = np.where(self._known[name], usual, np.copysign(usual, values))
            equal = equals_code(name, values)
            self._omit(name, CODE, equal & leaps(values, usual), time, row)
            plain = np.isfinite(values) & ~equal
            self._usual[name] = np.where(plain, values, self._usual[name])
            self._known[name] |= plain
        return {name: values.copy() for name, values in row.items()}

    def leave_out(
        self, time: float, row: dict[str, Array], acceleration: Array, oil: Array
    ) -> None:
        """Remove readings beyond the limits of the scene, and torques that do not belong together.

        Args:
            time: time of the row [s].
            row: readings in SI by channel, (n,) each; changed in place.
            acceleration: of the inputs [rad/s^2], (n,).
            oil: last temperatures of the oil [K], (n,).
        """
        for name, values in row.items():
            allowed = self._ranges[name]
            self._omit(name, limit_text(name, allowed), beyond(values, allowed), time, row)
        torques = row[TORQUES[0]], row[TORQUES[1]]
        speed = row["input_speed"]
        found = balance(self._train, torques, speed, self._inertia * acceleration)
        loss = np.full(len(speed), np.nan)
        if (doubtful := found.doubtful).any():
            oil = np.where(np.isfinite(row[OIL]), row[OIL], oil)
            loss[doubtful] = self._table(torques[0][doubtful], speed[doubtful], oil[doubtful]).total
        impossible = found.impossible(loss)
        usual = self._torques[0], self._torques[1]
        for name, wrong in zip(TORQUES, wrong_torques(self._train, torques, usual), strict=True):
            self._omit(name, IMPOSSIBLE, wrong & impossible, time, row)
        stuck = self._repeats.judge(row[TORQUES[0]][None], row[TORQUES[1]][None])
        for name, which in zip(TORQUES, stuck, strict=True):
            self._omit(name, STUCK, which[0], time, row)
        sound = np.isfinite(found.lost) & ~impossible
        self._torques = np.where(sound, torques, self._torques)

    def remarks(self, gearbox: int) -> Iterator[str]:
        """A line for each channel of a gearbox and reason.

        Args:
            gearbox: index of the gearbox.
        """
        if gearbox in self.left_out:
            yield from self.left_out[gearbox].remarks()

    def _omit(
        self,
        name: str,
        reason: str,
        which: NDArray[np.bool_],
        time: float,
        row: Mapping[str, Array],
    ) -> None:
        for n in np.flatnonzero(which):
            one = np.array([n])
            self.left_out.setdefault(int(n), LeftOut()).add(
                name, reason, np.array([time]), row[name][one], np.array([self._number])
            )
        row[name][which] = np.nan
