"""Undamped modes of the train for the meshes that are in contact and the stiffness they have.

Between two contact events the train is nearly linear: M x'' + C x' + K x = rest. In the modes of
K the left side falls apart into oscillators q'' + c q' + w^2 q, whose motion is known exactly
whatever the step. Each contact state has its modes; they are kept, because meshing returns to the
same states in every cycle.
"""

from __future__ import annotations

import math

import numpy as np

from .._compile import allocating, kernel
from .._records import BODIES, MESHES, REAL, SMALL, WHOLE, Record, layout
from ..dynamics.mesh_force import mesh_stiffness
from ..dynamics.state import OPEN
from ..mesh.tooth_pairs import SEGMENTS
from .radau import MOST

FIRST_PULL = 1e4  # [1/s]
ROOM = 256  # contact states kept

# Modes of the contact states met so far, of unit modal mass. Rows are what `combine` adds up:
# `form[n, m]` is what mode m does to the bodies, `share[n, j]` what body j does to the modes,
# `motion[n, m]` what mode m does to the meshes, and `reach` its magnitude [1/sqrt(kg)].
CONTACT_MODES = layout(
    count=WHOLE,
    key=(WHOLE, (ROOM, 2)),  # see `contact_key`
    follower=(WHOLE, (ROOM,)),  # the state that came next last time
    last=WHOLE,  # state found last
    stiffness=(REAL, (ROOM, MESHES)),  # of every mesh with its copies [N/m]
    form=(REAL, (ROOM, BODIES, BODIES)),
    share=(REAL, (ROOM, BODIES, BODIES)),
    motion=(REAL, (ROOM, BODIES, MESHES)),
    reach=(REAL, (ROOM, BODIES, MESHES)),
    square=(REAL, (ROOM, BODIES)),  # w^2 [1/s^2]
    varies=(SMALL, (ROOM,)),  # whether a stiffness changes within its segment
    step=(REAL, (ROOM,)),  # that did last time such a state began, 0: none yet [s]
    past_step=(REAL, (ROOM,)),  # see `memory`, 0: none yet [s]
    past_rest=(REAL, (ROOM, MOST + 1, BODIES)),
    past_rubbing=(REAL, (ROOM, MOST + 1, BODIES)),  # [N]
    pull=(REAL, (ROOM, 2)),  # by which a sweep brings the next closer, per step length [1/s]
    shaft_damping=(REAL, (ROOM, BODIES)),  # c of the couplings [1/s]
    mesh_damping=(REAL, (ROOM, 2, BODIES)),  # c/tau of each kind of mesh [1/s^2]
)


@kernel
def contact_key(train: Record, state: Record) -> tuple[int, int]:
    """Numbers for the stiffnesses of sun and ring meshes: their segments, 0 where they are open."""
    sun = ring = 0
    for i in range(train.meshes):
        segment = state.segment[i] + 1 if state.side[i] != OPEN else 0
        if train.kind[i] == 0:
            sun = sun * (SEGMENTS + 1) + segment
        else:
            ring = ring * (SEGMENTS + 1) + segment
    return sun, ring


@kernel
def find_modes(train: Record, state: Record, known: Record) -> int:
    """Place in `known` of the modes of the contacts of `state`, which are computed once."""
    key = contact_key(train, state)
    for likely in (known.last, known.follower[known.last]):
        if likely < known.count and _fits(known, likely, key):
            known.last = likely
            return likely
    n = _search(train, state, known, key)
    known.follower[known.last] = n
    known.last = n
    return n


@kernel
def _fits(known: Record, n: int, key: tuple[int, int]) -> bool:
    return known.key[n, 0] == key[0] and known.key[n, 1] == key[1]


@kernel
def _search(train: Record, state: Record, known: Record, key: tuple[int, int]) -> int:
    for n in range(known.count):
        if _fits(known, n, key):
            return n
    if known.count == ROOM:
        known.count = 0
    n = known.count
    known.count += 1
    known.key[n, 0], known.key[n, 1] = key
    _solve_modes(train, state, known, n)
    return n


@allocating
def _solve_modes(train: Record, state: Record, known: Record, n: int) -> None:
    bodies = train.bodies
    known.step[n] = known.past_step[n] = 0.0
    known.pull[n] = FIRST_PULL
    known.varies[n] = 1 if train.faults > 0 or train.lines[0] + train.lines[1] > 0 else 0
    scale = np.zeros(bodies + 1)
    for j in range(bodies):
        scale[j] = 1.0 / math.sqrt(train.mass[j])
    matrix = _stiffness_matrix(train, state, known, n, scale)
    squares, vectors = np.linalg.eigh(np.ascontiguousarray(matrix[:bodies, :bodies]))
    known.form[n] = known.share[n] = known.motion[n] = known.reach[n] = 0.0
    known.square[n] = known.shaft_damping[n] = known.mesh_damping[n] = 0.0
    for m in range(bodies):
        known.square[n, m] = max(squares[m], 0.0)
        for j in range(bodies):
            known.form[n, m, j] = known.share[n, j, m] = vectors[j, m] * scale[j]
        for i in range(train.meshes):
            motion = 0.0
            for a in range(3):
                motion += train.sign[i, a] * known.form[n, m, train.body[i, a]]
            known.motion[n, m, i], known.reach[n, m, i] = motion, abs(motion)
            known.mesh_damping[n, train.kind[i], m] += known.stiffness[n, i] * motion * motion
        for c in range(train.machines):
            p, q = train.coupling[c, 0], train.coupling[c, 1]
            twist = known.form[n, m, p] - known.form[n, m, q]
            known.shaft_damping[n, m] += train.coupling_damping[c] * twist * twist


@allocating
def _stiffness_matrix(
    train: Record, state: Record, known: Record, n: int, scale: np.ndarray
) -> np.ndarray:
    """K between the bodies and the ground, in coordinates of unit mass [1/s^2]."""
    matrix = np.zeros((train.bodies + 1, train.bodies + 1))
    for i in range(train.meshes):
        k = 0.0
        if state.side[i] != OPEN:
            kind, segment = train.kind[i], state.segment[i]
            middle = 0.5 * (train.edge[kind, segment] + train.edge[kind, segment + 1])
            k = mesh_stiffness(train, kind, segment, middle)
            if mesh_stiffness(train, kind, segment, train.edge[kind, segment]) != k:
                known.varies[n] = 1
            k *= train.copies[i]
        known.stiffness[n, i] = k
        for a in range(3):
            for b in range(3):
                p, q = train.body[i, a], train.body[i, b]
                matrix[p, q] += k * train.sign[i, a] * scale[p] * train.sign[i, b] * scale[q]
    for c in range(train.machines):
        k = train.coupling_stiffness[c]
        p, q = train.coupling[c, 0], train.coupling[c, 1]
        matrix[p, p] += k * scale[p] * scale[p]
        matrix[q, q] += k * scale[q] * scale[q]
        matrix[p, q] -= k * scale[p] * scale[q]
        matrix[q, p] -= k * scale[p] * scale[q]
    return matrix
