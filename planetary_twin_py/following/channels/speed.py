"""Tachometers at both shafts, or the speeds of drives."""

from __future__ import annotations

import math

from .sensor import Sensor, at_shaft, range_at

HIGHEST = 1.2  # multiple of the limit of the scene that a reading may reach


def speed_at(place: str) -> Sensor:
    """The tachometer at a shaft."""
    return Sensor(
        f"{place}_speed", "speed", "rad/s", ("rpm", "deg/s", "Hz"),
        lambda train: at_shaft(place, "speed", train.speed, train),
        lambda train: range_at(place, "speed", "rad/s", HIGHEST, train),
        written=((1.0, 0.0), (30.0 / math.pi, 0.0)), interface="velocity", shown=0.05,
    )  # fmt: skip
