"""Speeds of both shafts."""

from __future__ import annotations

import math

from ..train import FollowedTrain
from .sensor import Array, Range, Sensor

HIGHEST = 1.2  # multiple of the limit of the scene that a reading may reach


class Speed(Sensor):
    """A tachometer, or the speed of a drive."""

    quantity, unit, interface = "speed", "rad/s", "velocity"
    spellings = "rad/s, rpm, deg/s or Hz"
    shown = 0.05

    def nominal(self, train: FollowedTrain) -> float:
        """Magnitude at the operating point of the scene [rad/s]."""
        return train.speed * (1.0 if self.place == "input" else abs(train.ratio))

    def limits(self, train: FollowedTrain) -> Range:
        """Speeds that the shafts of a scene can have [rad/s]."""
        highest, limited_by = HIGHEST * train.speed_limit, f"{HIGHEST:g} times drive.speed_limit"
        if self.place == "input":
            return Range(-highest, highest, limited_by)
        highest *= abs(train.ratio)
        return Range(-highest, highest, f"{limited_by} at the output")

    def as_written(self, values: Array) -> list[Array]:
        """Readings in rad/s and rpm."""
        return [values, values * (30.0 / math.pi)]
