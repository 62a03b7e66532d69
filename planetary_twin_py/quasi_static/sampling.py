"""What a quasi-static run shows at one time."""

from __future__ import annotations

import math

from .._compile import kernel
from .._overwrite import copy_array
from .._records import Record
from ..dynamics.body_speed import body_speed
from ..dynamics.state import BEARING, CHURNING
from ..integrators.clock import Instant, Sampling, after, delay, due
from ..integrators.interpolant import Samples
from .equilibrium import settle
from .motion import roll, turn_to


@kernel
def sample(
    model: Record,
    tolerance: float,
    origin: Record,
    run: Record,
    at: Instant,
    out: Samples,
    row: int,
) -> None:
    """Write the sample at an instant into a row of `out`; `run` is as `settle` takes it."""
    train, state = model.train, run.state
    turn_to(model, origin, delay(origin, at), state)
    settle(model, tolerance, run, out.mesh[row])
    out.drag[row, 0] = run.evaluation.power[BEARING]
    out.drag[row, 1] = run.evaluation.power[CHURNING]
    copy_array(out.turns[row], state.turns)
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
    samples: Sampling,
    out: Samples,
) -> None:
    """Fill all rows of `out`; `origin` moves along."""
    for row in range(len(out.mesh)):
        at = due(samples)
        roll(model, origin, at)
        sample(model, tolerance, origin, run, at, out, row)
        samples = after(samples)
