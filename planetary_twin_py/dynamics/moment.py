"""What holds during one step: where the meshes stand at its start, and what decides their force.

Entry i of the arrays belongs to mesh i: what the tables of tooth pairs say of its segment lies
side by side with the other meshes, so that their forces can be computed in vector registers.
"""

from __future__ import annotations

import math

import numpy as np

from .._compile import kernel, law
from .._records import AXES, BODIES, MESHES, REAL, SMALL, WHOLE, Record, layout
from ..mesh.tooth_pairs import PAIRS, TERMS, TOTAL
from .cycle import cycle_shift, frame_cycle, nearest_to_segment
from .faults import FAULTS, find_faults
from .form_errors import LINES, place_lines
from .state import COAST_SIDE, OPEN

MOMENT = layout(
    start=(REAL, (MESHES,)),  # fraction of the mesh cycle at the start of the step
    side=(REAL, (MESHES,)),  # +1, -1, or 0: open
    segment=(WHOLE, (MESHES,)),  # 1 + that which the following arrays are of, 0: none yet
    low=(REAL, (MESHES,)),  # edges of the segment [cycles]
    high=(REAL, (MESHES,)),
    base=(REAL, (MESHES,)),  # law of stiffness [N/m]
    gain=(REAL, (MESHES,)),
    fixed=(REAL, (MESHES,)),  # damping time that does not follow the speed [s]
    external=(REAL, (MESHES,)),  # +1: external mesh, -1: internal
    weight=(REAL, (PAIRS + 1, TERMS, MESHES)),  # polynomials, see `mesh.tooth_pairs`
    rho1=(REAL, (PAIRS, MESHES)),  # radii of curvature of the pairs where the cycle is 0 [m]
    rho2=(REAL, (PAIRS, MESHES)),
    tau=(REAL, (2,)),  # damping time of each kind of mesh at the start [s]
    cycle_rate=REAL,  # mesh cycles per second of the frame, signed
    rigid=(REAL, (BODIES,)),  # speeds of the frame [rad/s]
    slew=(REAL, (AXES,)),  # of the speed set-points [rad/s^2]
    line_angle=(REAL, (MESHES, LINES)),  # of the errors of form at the start [rad]
    faulty=(SMALL, (MESHES, PAIRS, FAULTS)),  # which tooth pairs have which fault
)


@kernel
def set_moment(model: Record, state: Record, moment: Record) -> None:
    """Fill `moment` for a step that begins at `state`."""
    train = model.train
    moment.cycle_rate = frame_cycle_rate(train, state)
    for a in range(train.axes):
        gap = model.load.target_speed[a] - state.set_speed[a]
        moment.slew[a] = math.copysign(model.load.slew_rate, gap) if gap != 0.0 else 0.0
    for j in range(train.lanes):
        moment.rigid[j] = train.ratio[j, 0] * state.speed[0] + train.ratio[j, 1] * state.speed[1]
    rate = passing_rate(train, moment, state.v)
    for kind in range(2):
        moment.tau[kind] = damping_time(train, kind, rate)
    cycles = frame_cycle(train, state, 1) + cycle_shift(train, state.x)
    for i in range(train.meshes):
        place_mesh(train, state, moment, i, cycles)


@kernel
def place_mesh(train: Record, state: Record, moment: Record, i: int, cycles: float) -> None:
    """Fill what `moment` holds of mesh i, whose drive side has gone through so many cycles."""
    side = state.side[i]
    if train.lines[train.kind[i]] > 0:
        place_lines(train, state, i, moment.line_angle)
    if moment.segment[i] != state.segment[i] + 1 or moment.side[i] != side:
        take_segment(train, state, moment, i)
    if side == OPEN:
        moment.start[i] = moment.low[i]
        return
    cycle = side * (cycles - train.phase[i]) + (0.5 if side == COAST_SIDE else 0.0)
    moment.start[i] = nearest_to_segment(train, train.kind[i], state.segment[i], cycle)
    if train.faults > 0:
        find_faults(train, state, i, side, moment.start[i], moment.faulty)


@kernel
def take_segment(train: Record, state: Record, moment: Record, i: int) -> None:
    """Copy side and segment of mesh i from the tables; an open one carries nothing anywhere."""
    kind, segment, side = train.kind[i], state.segment[i], state.side[i]
    moment.side[i], moment.segment[i] = side, segment + 1
    moment.base[i], moment.gain[i] = train.stiffness_base[kind], train.stiffness_gain[kind]
    moment.fixed[i], moment.external[i] = train.damping_time[kind], train.external[kind]
    moment.low[i], moment.high[i] = train.edge[kind, segment], train.edge[kind, segment + 1]
    for t in range(train.terms):
        for p in range(train.slots):
            moment.weight[p, t, i] = train.weight[kind, segment, p, t] if side != OPEN else 0.0
        moment.weight[TOTAL, t, i] = train.weight[kind, segment, TOTAL, t]
    for p in range(train.slots):
        shift = train.shift[kind, segment, p] * train.base_pitch
        moment.rho1[p, i] = train.pitch_curvature[kind, 0] + shift
        moment.rho2[p, i] = train.pitch_curvature[kind, 1] - train.external[kind] * shift


@kernel
def frame_cycle_rate(train: Record, state: Record) -> float:
    """Mesh cycles per second of the rigid frame, signed."""
    rate = 0.0
    for a in range(AXES):
        rate += train.cycles[a] * state.speed[a]
    return rate / (2.0 * math.pi)


@law
def passing_rate(train: Record, moment: Record, v: np.ndarray) -> float:
    """Mesh cycles per second that the speeds of the motors stand for, unsigned."""
    rate = moment.cycle_rate
    for a in range(AXES):
        motor = train.coupling[2 * a, 0]
        rate += train.cycles[a] * v[motor] * train.inverse_radius[motor] / (2.0 * math.pi)
    return abs(rate)


@law
def damping_time(train: Record, kind: int, rate: float) -> float:
    """tau [s] of c = tau k, which may follow the rate at which teeth pass [1/s]."""
    return train.damping_time[kind] + train.damping_cycles / max(rate, train.lowest_frequency)
