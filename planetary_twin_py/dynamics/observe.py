"""What the meshes show at one instant: the quantities that are published and recorded."""

from __future__ import annotations

import numpy as np

from .._compile import kernel
from .._records import Record
from .equations import place_pairs
from .mesh_force import mesh_motion, press
from .state import OPEN
from .tooth_friction import evaluate, rolling_power

# Rows of the answer of `observe`.
DTE, MESH_FORCE, BOUNDARY, VISCOUS, FILM, LAMBDA, POWER_LOSS, MESH_POWER = range(8)
QUANTITIES = 8


@kernel
def observe(
    model: Record,
    state: Record,
    moment: Record,
    x: np.ndarray,
    v: np.ndarray,
    delay: float,
    pairs: Record,
    out: np.ndarray,
) -> None:
    """Fill out[:, i] for every mesh i; film and lambda ratio are NaN without contact.

    Both are means over the tooth pairs, weighted by load. Friction forces are magnitudes.
    """
    train = model.train
    out[:] = 0.0
    pairs.count = 0
    place_pairs(train, state, moment, x, v, delay, pairs)
    pairs.wanted = True
    for i in range(train.meshes):
        side = state.side[i]
        out[DTE, i] = mesh_motion(train, i, x)
        if side == OPEN:
            out[FILM, i] = out[LAMBDA, i] = np.nan
        else:
            force = press(model, state, moment, i, x, v, pairs)[0]
            out[MESH_FORCE, i] = side * max(force, 0.0)
            out[MESH_POWER, i] = max(force, 0.0) * train.base_pitch * abs(pairs.pace)
    evaluate(model, pairs)
    for p in range(pairs.count):
        i = pairs.mesh[p]
        out[FILM, i] += pairs.share[p] * pairs.film[p]
        out[LAMBDA, i] += pairs.share[p] * pairs.lambda_ratio[p]
        if train.friction:
            out[BOUNDARY, i] += pairs.boundary[p]
            out[VISCOUS, i] += pairs.viscous[p]
            out[POWER_LOSS, i] += pairs.friction[p] * pairs.sliding[p] + rolling_power(pairs, p)
