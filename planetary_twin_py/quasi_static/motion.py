"""Rigid motion: every motor at its set-point, every body by the tooth numbers."""

from __future__ import annotations

import math

from .._compile import kernel
from .._records import Record
from ..integrators.clock import Instant, run_on


@kernel
def turn_to(model: Record, origin: Record, after: float, state: Record) -> None:
    """Put frame, speeds and clock of `state` where the motors are `after` seconds after `origin`.

    It may be `origin` itself. Set-points run to their targets at the slew rate.
    """
    load = model.load
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
    run_on(origin, state, after)


@kernel
def roll(model: Record, origin: Record, until: Instant) -> None:
    """Move `origin` to the last whole second before `until`, second by second.

    Turns are counted off there, so that angles stay exact and do not depend on who asks when.
    """
    while origin.seconds < until.seconds:
        following = origin.seconds + 1
        turn_to(model, origin, 1.0 - origin.time, origin)
        origin.seconds, origin.time = following, 0.0
