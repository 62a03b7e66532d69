"""What the meshes show at one instant: the quantities that are published and recorded."""

from __future__ import annotations

import math

import numpy as np

from .._compile import kernel
from .._records import Record
from .equations import share_loads, squeeze
from .mesh_force import mesh_motion, move_meshes
from .state import OPEN
from .tooth_contact import lambda_ratio_of
from .tooth_friction import evaluate, turn_pairs

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
    work: Record,
    out: np.ndarray,
) -> None:
    """Fill out[:, i] for every mesh i; film and lambda ratio are NaN without contact.

    Both are means over the tooth pairs, weighted by load. Friction forces are magnitudes. `work`
    is an EVALUATION to work in.
    """
    train, oil, now, pairs = model.train, model.oil, work.now, work.pairs
    out[:] = 0.0
    move_meshes(train, x, v, now)
    squeeze(model, state, moment, x, v, delay, work)
    share_loads(model, moment, work)
    for i in range(train.meshes):
        side, force = state.side[i], max(now.push[i], 0.0)
        out[DTE, i] = mesh_motion(train, i, x)
        out[MESH_FORCE, i] = side * force
        out[MESH_POWER, i] = force * train.base_pitch * abs(now.pace)
        if side == OPEN:
            out[FILM, i] = out[LAMBDA, i] = np.nan
    turn_pairs(train, moment, v, pairs)
    evaluate(model, pairs)
    for p in range(train.slots):
        for i in range(train.meshes):
            k = p * train.meshes + i
            out[FILM, i] += pairs.share[k] * math.exp(pairs.log_film[k])
            ratio = lambda_ratio_of(oil, oil.prescribed, pairs.log_film[k])
            out[LAMBDA, i] += pairs.share[k] * ratio
            if train.friction:
                out[BOUNDARY, i] += pairs.boundary[k]
                out[VISCOUS, i] += pairs.viscous[k]
                lost = pairs.lost[k] if pairs.held else pairs.friction[k] * pairs.sliding[k]
                out[POWER_LOSS, i] += lost + pairs.rolling_power[k]
