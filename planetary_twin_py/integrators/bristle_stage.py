"""The shares of friction of pairs that hold, in the stages of Rosenbrock's method.

Each share z depends on itself and on the sliding V of its pair alone, so it is eliminated before
the linear system of a stage is solved: (1/(gamma h) + decay) u_z = r_z + gain u_V. Its friction is
f (z + tau dz/dt), f the full one and tau `RELAXATION`; so a pair adds
f gain (1 + tau/(gamma h))/(1/(gamma h) + decay) to the damping matrix.
"""

from __future__ import annotations

import numpy as np

from .._compile import kernel
from .._records import Record
from ..dynamics.tooth_friction import add_outer, sliding_row
from ..lubrication.presliding import RELAXATION


@kernel
def bristle_damping(
    train: Record, pairs: Record, step: float, row: np.ndarray, matrix: np.ndarray
) -> None:
    """Add to `matrix` what the pairs add to the damping matrix; `step` is gamma h [s]."""
    for k in range(pairs.count):
        i = k % train.meshes
        sliding_row(train, pairs, k, row)
        damping = pairs.full[k] * pairs.bristle_gain[k] / (1.0 / step + pairs.bristle_decay[k])
        damping *= 1.0 + RELAXATION / step
        add_outer(matrix, train.body[i], row, train.copies[i] * damping)


@kernel
def bend_bristles(
    pairs: Record, share: np.ndarray, weights: np.ndarray, bend: np.ndarray, stage: int
) -> None:
    """Shares of friction at a stage, from those at the start and the stages before."""
    if not pairs.held:
        return
    for k in range(share.size):
        value = share[k]
        for s in range(stage):
            value += weights[s] * bend[s, k]
        pairs.bristle[k] = value


@kernel
def pull_bristles(
    train: Record,
    start: Record,
    pairs: Record,
    steps: tuple[float, float],
    weights: np.ndarray,
    stage: int,
    right: np.ndarray,
    work: Record,
) -> None:
    """Fill r_z of a stage in its row of `work.bend`; add to `right` what it pulls the bodies by.

    Args:
        train: the train.
        start: pairs at the start of the step, whose derivatives the method uses.
        pairs: those of the stage.
        steps: h and gamma h [s].
        weights: of the stages before, C of the method (stages,).
        stage: number of the stage.
        right: right-hand side of the linear system (bodies + 1,) [N].
        work: room of the method.
    """
    h, step = steps
    for k in range(start.count):
        i = k % train.meshes
        rate = pairs.bristle_rate[k]
        for s in range(stage):
            rate += weights[s] * work.bend[s, k] / h
        work.bend[stage, k] = rate
        sliding_row(train, start, k, work.row)
        decay = start.bristle_decay[k]
        pull = train.copies[i] * start.full[k] * rate / (1.0 / step + decay)
        pull *= 1.0 - RELAXATION * decay
        for j in range(3):
            right[train.body[i, j]] -= pull * work.row[j]


@kernel
def solve_bristles(
    train: Record, start: Record, step: float, right: np.ndarray, stage: int, work: Record
) -> None:
    """u_z of a stage from its r_z and the solution u_v in `right`; `step` is gamma h [s]."""
    for k in range(start.count):
        i = k % train.meshes
        sliding_row(train, start, k, work.row)
        sliding = 0.0
        for j in range(3):
            sliding += work.row[j] * right[train.body[i, j]]
        rate = work.bend[stage, k] + start.bristle_gain[k] * sliding
        work.bend[stage, k] = rate / (1.0 / step + start.bristle_decay[k])
