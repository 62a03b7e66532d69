"""Tooth pairs that hold: static friction of all pairs, where the gears creep or stand still.

The traction curve of a rolling contact gets narrower the slower its flanks roll. Below `CREEPING`
bristles join them instead, see `lubrication.presliding`: each tooth pair has the share of its full
friction as a state of its own.
"""

from __future__ import annotations

import numpy as np

from .._compile import kernel, law
from .._overwrite import copy_array
from .._records import Record
from ..lubrication.presliding import RELAXATION, bristle_rate
from .creep import CREEPING

LEAST_FRICTION = 1e-12  # [N] a pair with less has no bristles to bend


@law
def creeps(train: Record, cycle_rate: float) -> bool:
    """Whether the frame turns so slowly that tooth pairs hold."""
    slow: bool = train.rolling_advance * abs(cycle_rate) < CREEPING
    return slow and train.friction and not train.printed_torque


@kernel
def place_bristles(pairs: Record, share: np.ndarray) -> None:
    """Let the pairs have the shares of friction that a state gives them."""
    if pairs.held:
        copy_array(pairs.bristle, share)


@kernel
def hold(oil: Record, pairs: Record) -> None:
    """Replace the friction of the traction curve by that of the bristles.

    Reads the friction of `tooth_friction.evaluate` and the shares in `pairs.bristle`.
    """
    for k in range(pairs.count):
        full, share = pairs.boundary[k] + pairs.viscous[k], pairs.bristle[k]
        pairs.full[k] = full
        pairs.bristle_rate[k] = pairs.bristle_decay[k] = pairs.bristle_gain[k] = 0.0
        pairs.lost[k], force = 0.0, share
        if full > LEAST_FRICTION:
            steady, slope = pairs.friction[k] / full, pairs.slope[k] / full
            rate, decay, gain, slip = bristle_rate(
                share, pairs.sliding[k], steady, slope, oil.presliding
            )
            pairs.bristle_rate[k], pairs.bristle_decay[k] = rate, decay
            pairs.bristle_gain[k] = gain
            damping = RELAXATION * rate
            force += damping
            pairs.lost[k] = full * (share * slip + damping * pairs.sliding[k])
        pairs.friction[k] = full * force
        pairs.boundary[k] *= abs(force)
        pairs.viscous[k] *= abs(force)


@kernel
def steady_bristles(pairs: Record, share: np.ndarray) -> None:
    """Fill the shares of friction from the traction curve, as the pairs begin to hold."""
    share[:] = 0.0
    for k in range(pairs.count):
        full = pairs.boundary[k] + pairs.viscous[k]
        if full > LEAST_FRICTION:
            share[k] = pairs.friction[k] / full


@kernel
def pass_bristles(train: Record, share: np.ndarray, i: int, segment: int, direction: int) -> None:
    """Carry the shares of the pairs of mesh i over from a segment to the next in a direction.

    A pair stands at cycle + shift: where the cycle begins again, its shift is one more.
    """
    kind, count = train.kind[i], train.segments[train.kind[i]]
    after = (segment + direction) % count
    wrapped = direction if after != segment + direction else 0
    old, new = train.shift[kind, segment], train.shift[kind, after]
    before0, before1, before2 = share[i], share[train.meshes + i], share[2 * train.meshes + i]
    for p in range(train.slots):
        share[p * train.meshes + i] = 0.0
    for q in range(train.present[kind, segment]):
        value = before0 if q == 0 else (before1 if q == 1 else before2)
        for p in range(train.present[kind, after]):
            if new[p] == old[q] + wrapped:
                share[p * train.meshes + i] = value


@kernel
def clear_bristles(train: Record, share: np.ndarray, i: int) -> None:
    """Flanks of mesh i part, or meet for the first time: nothing holds."""
    for p in range(train.slots):
        share[p * train.meshes + i] = 0.0
