"""Rigid motion: every motor at its set-point, every body by the tooth numbers."""

from __future__ import annotations

import math

from .._compile import kernel
from .._records import Record


@kernel
def turn_to(model: Record, origin: Record, time: float, state: Record) -> None:
    """Put frame, speeds and clock of `state` where the motors are at `time` [s].

    `origin` holds them at an earlier time; it may be `state` itself. Set-points run to
    their targets at the slew rate.
    """
    load, after = model.load, time - origin.time
    for a in range(model.train.axes):
        begin, target = origin.set_speed[a], load.target_speed[a]
        slew = math.copysign(load.slew_rate, target - begin)
        ramp = min(after, abs(target - begin) / load.slew_rate)
        speed = begin + slew * ramp if ramp == after else target
        angle = (begin + 0.5 * slew * ramp) * ramp + target * (after - ramp)
        fraction = origin.fraction[a] + angle / (2.0 * math.pi)
        state.turns[a] = origin.turns[a] + math.floor(fraction)
        state.fraction[a] = fraction - math.floor(fraction)
        state.speed[a] = state.set_speed[a] = speed
    state.time = time
