"""What a quasi-static run shows at one time."""

from __future__ import annotations

import math

from .._compile import kernel
from .._records import Record
from ..dynamics.body_speed import body_speed
from ..dynamics.state import BEARING, CHURNING
from ..integrators.interpolant import Samples
from .equilibrium import settle
from .motion import turn_to


@kernel
def sample(
    model: Record,
    tolerance: float,
    origin: Record,
    run: Record,
    time: float,
    out: Samples,
    row: int,
) -> None:
    """Write the sample at `time` [s] into a row of `out`; `run` is as `settle` takes it."""
    train, state = model.train, run.state
    turn_to(model, origin, time, state)
    settle(model, tolerance, run, out.mesh[row])
    out.drag[row, 0] = run.evaluation.power[BEARING]
    out.drag[row, 1] = run.evaluation.power[CHURNING]
    out.turns[row] = state.turns
    for j in range(train.bodies):
        out.speed[row, j] = body_speed(train, state, state.v, j)
        out.angle[row, j] = 0.0
        for a in range(train.axes):
            out.angle[row, j] += train.ratio[j, a] * 2.0 * math.pi * state.fraction[a]


@kernel
def sample_all(
    model: Record,
    tolerance: float,
    origin: Record,
    run: Record,
    counts: tuple[int, int, int],
    sample_rate: float,
    out: Samples,
) -> None:
    """Samples number counts[0] on into the rows from counts[1] to counts[2] of `out`."""
    first, begin, end = counts
    for row in range(begin, end):
        sample(model, tolerance, origin, run, (first + row) / sample_rate, out, row)
