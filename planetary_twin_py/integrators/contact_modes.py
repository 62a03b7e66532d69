"""Undamped modes of the train for the meshes that are in contact and the stiffness they have.

Between two contact events the train is nearly linear: M x'' + C x' + K x = rest. In the modes of
K the left side falls apart into oscillators q'' + c q' + w^2 q, whose motion is known exactly
whatever the step. Each contact state has its modes; they are kept, because meshing returns to the
same states in every cycle.
"""

from __future__ import annotations

import math

import numpy as np

from .._compile import kernel
from .._records import BODIES, MESHES, REAL, SMALL, WHOLE, Record, layout
from ..dynamics.mesh_force import mesh_stiffness
from ..dynamics.state import OPEN
from ..mesh.tooth_pairs import SEGMENTS

FIRST_PULL = 1e4  # [1/s]
ROOM = 256  # contact states kept

# Modes of the contact states met so far. Mode m moves body j by form[j, m], with unit modal mass.
CONTACT_MODES = layout(
    count=WHOLE,
    key=(WHOLE, (ROOM, 2)),  # see `contact_key`
    stiffness=(REAL, (ROOM, MESHES)),  # of every mesh [N/m]
    form=(REAL, (ROOM, BODIES, BODIES)),  # [1/sqrt(kg)], the ground stands still
    square=(REAL, (ROOM, BODIES)),  # w^2 [1/s^2]
    motion=(REAL, (ROOM, MESHES, BODIES)),  # of the meshes in the modes [1/sqrt(kg)]
    varies=(SMALL, (ROOM,)),  # whether a stiffness changes within its segment
    step=(REAL, (ROOM,)),  # that did last time such a state began, 0: none yet [s]
    pull=(REAL, (ROOM, 2)),  # by which a sweep brings the next closer, per step length [1/s]
    shaft_damping=(REAL, (ROOM, BODIES)),  # c of the couplings [1/s]
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
    sun, ring = contact_key(train, state)
    for n in range(known.count):
        if known.key[n, 0] == sun and known.key[n, 1] == ring:
            return n
    if known.count == ROOM:
        known.count = 0
    n = known.count
    known.count += 1
    known.key[n, 0], known.key[n, 1] = sun, ring
    _solve_modes(train, state, known, n)
    return n


@kernel
def _solve_modes(train: Record, state: Record, known: Record, n: int) -> None:
    bodies = train.bodies
    known.step[n] = 0.0
    known.pull[n] = FIRST_PULL
    known.varies[n] = 1 if train.faults > 0 or train.lines[0] + train.lines[1] > 0 else 0
    matrix = np.zeros((bodies + 1, bodies + 1))
    scale = np.zeros(bodies + 1)
    for j in range(bodies):
        scale[j] = 1.0 / math.sqrt(train.mass[j])
    for i in range(train.meshes):
        k = 0.0
        if state.side[i] != OPEN:
            kind, segment = train.kind[i], state.segment[i]
            middle = 0.5 * (train.edge[kind, segment] + train.edge[kind, segment + 1])
            k = mesh_stiffness(train, kind, segment, middle)
            if mesh_stiffness(train, kind, segment, train.edge[kind, segment]) != k:
                known.varies[n] = 1
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
    squares, vectors = np.linalg.eigh(np.ascontiguousarray(matrix[:bodies, :bodies]))
    known.form[n] = 0.0
    for m in range(bodies):
        known.square[n, m] = max(squares[m], 0.0)
        for j in range(bodies):
            known.form[n, j, m] = vectors[j, m] * scale[j]
        for i in range(train.meshes):
            motion = 0.0
            for a in range(3):
                motion += train.sign[i, a] * known.form[n, train.body[i, a], m]
            known.motion[n, i, m] = motion
        damping = 0.0
        for c in range(train.machines):
            p, q = train.coupling[c, 0], train.coupling[c, 1]
            twist = known.form[n, p, m] - known.form[n, q, m]
            damping += train.coupling_damping[c] * twist * twist
        known.shaft_damping[n, m] = damping
