"""Tachometers at both shafts, or the speeds of drives."""

from __future__ import annotations

import math

from ..train import FollowedTrain
from .sensor import Range, Sensor, at_shaft, seen_at

HIGHEST = 1.2  # multiple of the limit of the scene that a reading may reach


def speed_at(place: str) -> Sensor:
    """The tachometer at a shaft."""

    def limits(train: FollowedTrain) -> Range:
        highest = at_shaft(place, "speed", HIGHEST * train.speed_limit, train)
        limit = f"{HIGHEST:g} times drive.speed_limit{seen_at(place)}, {highest:.4g} rad/s"
        return Range(-highest, highest, limit)

    return Sensor(
        f"{place}_speed", "speed", "rad/s", ("rpm", "deg/s", "Hz"),
        lambda train: at_shaft(place, "speed", train.speed, train), limits,
        written=((1.0, 0.0), (30.0 / math.pi, 0.0)), interface="velocity", shown=0.05,
    )  # fmt: skip
