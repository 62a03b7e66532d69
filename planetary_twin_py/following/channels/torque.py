"""Torque transducers at both shafts."""

from __future__ import annotations

from ..train import FollowedTrain
from .sensor import Range, Sensor, at_shaft, seen_at

HIGHEST = 2.0  # multiple of the limit of the scene that a reading may reach


def torque_at(place: str) -> Sensor:
    """The torque transducer at a shaft."""

    def limits(train: FollowedTrain) -> Range:
        highest = at_shaft(place, "torque", HIGHEST * train.torque_limit, train)
        limit = f"{HIGHEST:g} times drive.torque_limit{seen_at(place)}, {highest:.4g} N m"
        return Range(-highest, highest, limit)

    return Sensor(
        f"{place}_torque", "torque", "N m", ("lbf ft", "N mm", "kN m"),
        lambda train: at_shaft(place, "torque", train.torque, train), limits,
        written=((1.0, 0.0), (1e-3, 0.0), (1e3, 0.0)), interface="effort", shown=0.2,
    )  # fmt: skip
