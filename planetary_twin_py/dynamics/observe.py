"""What a mesh shows at one instant: the quantities that are published and recorded."""

from __future__ import annotations

import numpy as np

from .._compile import kernel
from .._records import Record
from ..mesh.tooth_pairs import PAIRS
from .equations import cycle_shift, mesh_motion, stiffness
from .state import OPEN
from .tooth_contact import tooth_contact

# Rows of the answer of `observe`.
DTE, MESH_FORCE, BOUNDARY, VISCOUS, FILM, LAMBDA, POWER_LOSS = range(7)
QUANTITIES = 7


@kernel
def observe(
    model: Record, state: Record, moment: Record, x: np.ndarray, v: np.ndarray, delay: float,
    out: np.ndarray,
) -> None:
    """Fill out[:, i] for every mesh i; film and lambda ratio are NaN without contact.

    Both are means over the tooth pairs, weighted by load. Friction forces are magnitudes.
    """
    train = model.train
    advance = moment.cycle_rate * delay + cycle_shift(train, x) - cycle_shift(train, state.x)
    for i in range(train.meshes):
        side = state.side[i]
        d = mesh_motion(train, i, x)
        out[:, i] = 0.0
        out[DTE, i] = d
        out[FILM, i] = out[LAMBDA, i] = np.nan
        if side == OPEN:
            continue
        kind, segment = train.kind[i], state.segment[i]
        cycle = moment.start[i] + side * advance
        k = stiffness(train, kind, segment, cycle)
        rate = side * mesh_motion(train, i, v)
        force = k * (side * d - model.load.half_backlash + moment.tau[kind] * rate)
        out[MESH_FORCE, i] = side * max(force, 0.0)
        _observe_pairs(model, state, i, cycle, max(force, 0.0), v, out)


@kernel
def _observe_pairs(
    model: Record, state: Record, i: int, cycle: float, force: float, v: np.ndarray,
    out: np.ndarray,
) -> None:
    train = model.train
    kind, segment = train.kind[i], state.segment[i]
    first, second, carrier = train.body[i, 0], train.body[i, 1], train.body[i, 2]
    speed = state.speed
    frame = train.ratio[carrier] * speed + v[carrier] / train.radius[carrier]
    speed1 = train.ratio[first] * speed + v[first] / train.radius[first] - frame
    speed2 = train.ratio[second] * speed + v[second] / train.radius[second] - frame
    total = 0.0
    for p in range(PAIRS):
        total += max(train.offset[kind, segment, p] + train.slope[kind, segment, p] * cycle, 0.0)
    out[FILM, i] = out[LAMBDA, i] = 0.0
    for p in range(PAIRS):
        share = (train.offset[kind, segment, p] + train.slope[kind, segment, p] * cycle) / total
        if share <= 0.0:
            continue
        s = (cycle + train.shift[kind, segment, p]) * train.base_pitch
        signed, boundary, viscous, film, ratio, sliding = tooth_contact(
            model.oil, train.pitch_curvature[kind, 0] + s,
            train.pitch_curvature[kind, 1] - train.external[kind] * s, train.external[kind],
            speed1, speed2, share * force, model.load.lambda_ratio,
        )
        out[FILM, i] += share * film
        out[LAMBDA, i] += share * ratio
        if train.friction:
            out[BOUNDARY, i] += boundary
            out[VISCOUS, i] += viscous
            out[POWER_LOSS, i] += signed * sliding
