"""When flanks meet and part, and when tooth pairs enter and leave a mesh.

A mesh is on its drive side, on its coast side, or open. Its force F = k (d - b) + c d' must push:
in contact it ends where F falls below zero, which damping makes happen at d > b; open, contact
begins where both d - b and F are positive, with a jump of F by c d'. (Al-shyyab and Kahraman 2007
for the dead zone; the flanks never pull.)
"""

from __future__ import annotations

import math

import numpy as np

from .._compile import kernel
from .._records import Record
from .equations import cycle_shift, mesh_motion, stiffness
from .state import COAST_SIDE, DAMPING, DRIVE_SIDE, OPEN, STIFFNESS_WORK


@kernel
def frame_cycle(train: Record, turns: float, fraction: float) -> float:
    """Mesh cycles of the rigid train at a motor angle, modulo 1, exact in whole turns."""
    whole = int(turns) * train.cycles_numerator % train.cycles_denominator
    cycle = whole / train.cycles_denominator + train.cycles * fraction
    return cycle - math.floor(cycle)


@kernel
def mesh_cycle(train: Record, state: Record, i: int, side: int) -> float:
    """Fraction of its cycle at which mesh i stands on one side, in [0, 1).

    The coast flanks see the motion mirrored, half a pitch later.
    """
    cycle = frame_cycle(train, state.turns, state.fraction)
    cycle = side * (cycle + cycle_shift(train, state.x) - train.phase[i])
    if side == COAST_SIDE:
        cycle += 0.5
    return cycle - math.floor(cycle)


@kernel
def find_segment(train: Record, kind: int, cycle: float, direction: float) -> int:
    """Segment of the table of tooth pairs at a fraction of the cycle; at an edge, the one ahead."""
    last = train.segments[kind] - 1
    segment = 0
    while segment < last and train.edge[kind, segment + 1] <= cycle:
        segment += 1
    if direction < 0.0 and cycle == train.edge[kind, segment]:
        segment = segment - 1 if segment > 0 else last
    return segment


@kernel
def flank_force(
    model: Record, i: int, side: int, segment: int, cycle: float, tau: float, d: float, rate: float
) -> tuple[float, float]:
    """Compression d - b [m] of the flanks on `side`, and the force k (d - b) + c d' [N]."""
    k = stiffness(model.train, model.train.kind[i], segment, cycle)
    squeeze = side * d - model.load.half_backlash
    return squeeze, k * (squeeze + tau * side * rate)


@kernel
def departure(
    model: Record, state: Record, i: int, tau: float, d: float, rate: float, slack: float
) -> float:
    """Play [m] that mesh i has left before its contact changes; negative: it has changed.

    Contact ends where d - b + tau d', which is F/k, falls below zero, and begins where that and
    d - b are positive, on whichever side. Both by `slack`: without load, flanks rest against each
    other with no force, and would part and meet without end.
    """
    side = state.side[i]
    half = model.load.half_backlash
    if side != OPEN:
        return side * (d + tau * rate) - half + slack
    drive = min(d, d + tau * rate) - half
    coast = min(-d, -d - tau * rate) - half
    return slack - max(drive, coast)


@kernel
def _elastic_energy(model: Record, state: Record, i: int) -> float:
    """Energy [J] stored in mesh i."""
    side = state.side[i]
    if side == OPEN:
        return 0.0
    cycle = mesh_cycle(model.train, state, i, side)
    cycle = nearest_to_segment(model.train, model.train.kind[i], state.segment[i], cycle)
    d = mesh_motion(model.train, i, state.x)
    squeeze, force = flank_force(model, i, side, state.segment[i], cycle, 0.0, d, 0.0)
    return 0.5 * force * squeeze


@kernel
def nearest_to_segment(train: Record, kind: int, segment: int, cycle: float) -> float:
    """The representative of `cycle` modulo 1 that lies in or next to a segment."""
    middle = 0.5 * (train.edge[kind, segment] + train.edge[kind, segment + 1])
    return cycle - math.floor(cycle - middle + 0.5)


@kernel
def change_contact(model: Record, state: Record, i: int) -> None:
    """Close an open mesh on the side it has reached, or open a closed one.

    What the flanks still store at the moment they part is lost in the material: flanks part at
    d > b, and later meet again at no compression.
    """
    before = _elastic_energy(model, state, i)
    if state.side[i] == OPEN:
        side = DRIVE_SIDE if mesh_motion(model.train, i, state.x) > 0.0 else COAST_SIDE
        kind = model.train.kind[i]
        state.segment[i] = find_segment(
            model.train, kind, mesh_cycle(model.train, state, i, side), 1.0
        )
        state.side[i] = side
    else:
        state.side[i] = OPEN
    state.energy[DAMPING] += before - _elastic_energy(model, state, i)


@kernel
def change_segment(model: Record, state: Record, i: int, direction: int) -> None:
    """Move mesh i to the next segment; a jump of the stiffness does work on the train."""
    count = model.train.segments[model.train.kind[i]]
    before = _elastic_energy(model, state, i)
    state.segment[i] = (state.segment[i] + direction) % count
    state.energy[STIFFNESS_WORK] += _elastic_energy(model, state, i) - before


@kernel
def elastic_energies(model: Record, state: Record, out: np.ndarray) -> float:
    """Elastic energy of all meshes and couplings [J]; `out` receives that of each mesh."""
    train = model.train
    total = 0.0
    for i in range(train.meshes):
        out[i] = _elastic_energy(model, state, i)
        total += out[i]
    for c in range(2):
        twist = state.x[train.coupling[c, 0]] - state.x[train.coupling[c, 1]]
        total += 0.5 * train.coupling_stiffness[c] * twist * twist
    return total
