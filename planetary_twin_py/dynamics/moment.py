"""What holds during one step: where the meshes stand at its start, and the pace they keep."""

from __future__ import annotations

import math

import numpy as np

from .._compile import kernel, law
from .._records import AXES, MESHES, REAL, SMALL, Record, layout
from ..mesh.tooth_pairs import PAIRS
from .cycle import mesh_cycle, nearest_to_segment
from .faults import FAULTS, find_faults
from .form_errors import LINES, place_lines
from .state import OPEN

MOMENT = layout(
    start=(REAL, (MESHES,)),  # fraction of the mesh cycle at the start of the step
    tau=(REAL, (2,)),  # damping time of each kind of mesh at the start [s]
    cycle_rate=REAL,  # mesh cycles per second of the frame, signed
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
    for kind in range(2):
        moment.tau[kind] = damping_time(train, moment, state.v, kind)
    for i in range(train.meshes):
        place_mesh(train, state, moment, i)


@kernel
def place_mesh(train: Record, state: Record, moment: Record, i: int) -> None:
    """Fill what `moment` holds of mesh i."""
    side = state.side[i]
    if train.lines[train.kind[i]] > 0:
        place_lines(train, state, i, moment.line_angle)
    if side == OPEN:
        return
    cycle = mesh_cycle(train, state, i, side)
    moment.start[i] = nearest_to_segment(train, train.kind[i], state.segment[i], cycle)
    if train.faults > 0:
        find_faults(train, state, i, side, moment.start[i], moment.faulty)


@kernel
def frame_cycle_rate(train: Record, state: Record) -> float:
    """Mesh cycles per second of the rigid frame, signed."""
    rate = 0.0
    for a in range(AXES):
        rate += train.cycles[a] * state.speed[a]
    return rate / (2.0 * math.pi)


@law
def damping_time(train: Record, moment: Record, v: np.ndarray, kind: int) -> float:
    """tau [s] of c = tau k, which may follow the speeds of the motors."""
    rate = moment.cycle_rate
    for a in range(AXES):
        motor = train.coupling[2 * a, 0]
        rate += train.cycles[a] * v[motor] / (2.0 * math.pi * train.radius[motor])
    return train.damping_time[kind] + train.damping_cycles / max(abs(rate), train.lowest_frequency)
