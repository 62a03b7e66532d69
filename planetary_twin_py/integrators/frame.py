"""The frame of the motors, in which bodies are placed, and how it turns with the clock."""

from __future__ import annotations

import math

from .._compile import kernel
from .._records import Record
from .clock import run_on


@kernel
def rebase(train: Record, state: Record) -> None:
    """Let the frame catch up with the motors: their x and v become zero."""
    for a in range(train.axes):
        motor = train.coupling[2 * a, 0]
        angle, rate = state.x[motor] / train.radius[motor], state.v[motor] / train.radius[motor]
        for j in range(train.bodies):
            state.x[j] -= train.ratio[j, a] * train.radius[j] * angle
            state.v[j] -= train.ratio[j, a] * train.radius[j] * rate
        state.x[motor] = 0.0
        state.v[motor] = 0.0
        state.speed[a] += rate
        _turn(state, a, angle / (2.0 * math.pi))


@kernel
def _turn(state: Record, a: int, turns: float) -> None:
    """Turn the frame with motor a; whole turns are counted apart."""
    fraction = state.fraction[a] + turns
    state.turns[a] += math.floor(fraction)
    state.fraction[a] = fraction - math.floor(fraction)


@kernel
def pass_time(model: Record, march: Record, h: float) -> None:
    """Let clock, set-points and frame of `end` run on for h seconds."""
    begin, end = march.begin, march.end
    run_on(begin, end, h)
    for a in range(model.train.axes):
        end.set_speed[a] = begin.set_speed[a] + march.moment.slew[a] * h
        _turn(end, a, begin.speed[a] * h / (2.0 * math.pi))
    march.control.step = h
