"""Averages readings over bins, and compares units, signs and stamps with the scene."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator, Mapping

from ..scene import Scene
from .bins import Array, Bin, Counters
from .checks import Checks
from .dead_torques import DeadTorques
from .merging import Merge
from .sensors import Sensors, torque_noise
from .spacing import Spacing
from .train import FollowedTrain, followed_train
from .unit_remarks import UnitRemarks

PERIOD = 0.1  # [s] length of a bin; in longer bins innovations correlate when the load reverses


class CheckedBins:
    """Bins of readings that are checked as they close.

    Args:
        scene: scene of the gearbox, with one input.
        train: its gear train.
        sensors: accuracy of the sensors.
        period: length of a bin [s].
    """

    def __init__(self, scene: Scene, train: FollowedTrain, sensors: Sensors, period: float) -> None:
        noise = torque_noise(sensors, train)
        self._ratio, self._period = train.ratio, period
        self._merge = Merge(period, {"input_torque": noise[0], "output_torque": noise[1]})
        self._checks = Checks(train, sensors, period)
        self._spacing = Spacing()
        self._dead_torques = DeadTorques(train, period)
        self._unit_remarks = UnitRemarks(scene.operating_point)

    @property
    def counters(self) -> Counters:
        """Numbers of readings that were not used, by reason."""
        return self._merge.counters

    def add(self, time: Array, columns: Mapping[str, Array], sender: str) -> Iterator[Bin]:
        """Add readings of a sender in the order of their arrival.

        Args:
            time: stamps [s], (n,).
            columns: readings in SI by channel, (n,) each; NaN where a reading is missing.
            sender: name of the sender.

        Returns:
            The bins that are complete, in order.

        Raises:
            InputError: a channel has another unit, sign or shaft, see `checks`.
        """
        for time_bin in self._merge.add(time, columns, sender):
            yield self._checked(time_bin)

    def finish(self) -> Iterator[Bin]:
        """Close the open bins, at the end of a recording.

        Returns:
            The last bins.

        Raises:
            InputError: see `add`.
        """
        for time_bin in self._merge.finish():
            yield self._checked(time_bin)
        self._checks.check()

    def remarks(self) -> Iterator[str]:
        """A line for each unit that may be wrong, each later contradiction and dead torque."""
        yield from self._checks.remarks()
        yield from self._dead_torques.remarks()
        yield from self._spacing.remarks(self._period)
        yield from self._unit_remarks.remarks()

    def _checked(self, time_bin: Bin) -> Bin:
        time_bin = self._checks.add(time_bin)
        self._spacing.add((time_bin.number + 1) * self._period)
        values = {name: mean.value for name, mean in time_bin.means.items()}
        speed = values.get("input_speed", values.get("output_speed", math.nan) / self._ratio)
        self._dead_torques.add(time_bin.number * self._period, values, speed)
        self._unit_remarks.add(values.get("input_torque", math.nan), speed)
        return time_bin


def table_remarks(
    scene: Scene, sensors: Sensors, time: Array, columns: Mapping[str, Array]
) -> tuple[str, ...]:
    """Check all readings of a table.

    Args:
        scene: scene of the gearbox, with one input.
        sensors: accuracy of the sensors.
        time: stamps [s] in order, (n,).
        columns: readings in SI by channel, (n,) each; NaN where a reading is missing.

    Returns:
        A line for each unit that may be wrong, each later contradiction and dead torque.

    Raises:
        InputError: a channel has another unit, sign or shaft, see `checks`.
    """
    bins = CheckedBins(scene, followed_train(scene), sensors, PERIOD)
    for part in (bins.add(time, columns, "table"), bins.finish()):
        deque(part, maxlen=0)  # a bin is checked when it is taken
    return tuple(bins.remarks())
