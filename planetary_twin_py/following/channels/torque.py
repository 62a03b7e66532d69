"""Torque transducers at both shafts."""

from __future__ import annotations

from .sensor import Sensor, at_shaft, range_at

HIGHEST = 2.0  # multiple of the limit of the scene that a reading may reach


def torque_at(place: str) -> Sensor:
    """The torque transducer at a shaft."""
    return Sensor(
        f"{place}_torque", "torque", "N m", ("lbf ft", "N mm", "kN m"),
        lambda train: at_shaft(place, "torque", train.torque, train),
        lambda train: range_at(place, "torque", "N m", HIGHEST, train),
        written=((1.0, 0.0), (1e-3, 0.0), (1e3, 0.0)), interface="effort", shown=0.2,
    )  # fmt: skip
