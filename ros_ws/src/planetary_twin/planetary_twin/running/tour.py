"""The tour of a run: a sequence of changes of the operating point."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from planetary_twin_py import rpm

LENGTH = 12.0  # [s] duration of a run for which the times below are given; they scale with it


class Stop(NamedTuple):
    """At simulated `time` [s], set `values` (SI) and show `caption`."""

    time: float
    values: Mapping[str, float]
    caption: str


PAPER: Sequence[Stop] = (
    Stop(0.0, {}, "steady: 1000 rpm, 63 N m, lambda ratio 1"),
    Stop(2.0, {"lambda_ratio": 2.0}, "lambda ratio 1 -> 2: the film separates the asperities"),
    Stop(
        3.5, {"backlash": 3.5e-7}, "backlash 0.2 -> 0.35 um: DTE under load shifts by half of it"
    ),
    Stop(5.0, {"input_speed": rpm(2000)}, "1000 -> 2000 rpm: mesh frequency and losses follow"),
    Stop(
        7.0,
        {"input_torque": 0.3, "torque_ripple": 1.0},
        "light load with torque ripple: teeth separate and rattle",
    ),
    Stop(9.0, {"input_torque": 63.0, "torque_ripple": 0.0}, "63 N m again"),
    Stop(10.0, {"input_speed": rpm(3000)}, "2000 -> 3000 rpm"),
)
TOURS: Mapping[str, Sequence[Stop]] = {"paper": PAPER}


def tour_of(scene: str, duration: float) -> list[Stop]:
    """Return the stops for a packaged scene in a run of `duration` [s]; none for other scenes."""
    scale = duration / LENGTH if math.isfinite(duration) else 1.0
    return [stop._replace(time=stop.time * scale) for stop in TOURS.get(scene, ())]
