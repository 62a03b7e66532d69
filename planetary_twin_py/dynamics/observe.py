"""What the meshes show at one instant: the quantities that are published and recorded."""

from __future__ import annotations

import numpy as np

from .._compile import kernel
from .._records import Record
from .equations import cycle_shift, mesh_motion, stiffness
from .state import OPEN
from .tooth_friction import evaluate, gather

# Rows of the answer of `observe`.
DTE, MESH_FORCE, BOUNDARY, VISCOUS, FILM, LAMBDA, POWER_LOSS = range(7)
QUANTITIES = 7


@kernel
def observe(
    model: Record, state: Record, moment: Record, x: np.ndarray, v: np.ndarray, delay: float,
    pairs: Record, out: np.ndarray,
) -> None:
    """Fill out[:, i] for every mesh i; film and lambda ratio are NaN without contact.

    Both are means over the tooth pairs, weighted by load. Friction forces are magnitudes.
    """
    train = model.train
    advance = moment.cycle_rate * delay + cycle_shift(train, x) - cycle_shift(train, state.x)
    out[:] = 0.0
    pairs.count = 0
    for i in range(train.meshes):
        side = state.side[i]
        d = mesh_motion(train, i, x)
        out[DTE, i] = d
        if side == OPEN:
            out[FILM, i] = out[LAMBDA, i] = np.nan
            continue
        kind, segment = train.kind[i], state.segment[i]
        cycle = moment.start[i] + side * advance
        k = stiffness(train, kind, segment, cycle)
        rate = side * mesh_motion(train, i, v)
        force = k * (side * d - model.load.half_backlash + moment.tau[kind] * rate)
        out[MESH_FORCE, i] = side * max(force, 0.0)
        gather(model, state, i, cycle, max(force, 0.0), v, pairs)
    evaluate(model, pairs)
    for p in range(pairs.count):
        i = pairs.mesh[p]
        out[FILM, i] += pairs.share[p] * pairs.film[p]
        out[LAMBDA, i] += pairs.share[p] * pairs.lambda_ratio[p]
        if train.friction:
            out[BOUNDARY, i] += pairs.boundary[p]
            out[VISCOUS, i] += pairs.viscous[p]
            out[POWER_LOSS, i] += pairs.friction[p] * pairs.sliding[p]
