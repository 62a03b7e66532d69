"""The gearbox as one function (t, y) -> dy, which is all that an off-the-shelf solver wants.

Nothing is remembered between two calls: which flanks touch and where every mesh stands in its
table of tooth pairs follow from t and y by the laws of `dynamics`, so the function jumps in its
derivatives wherever a tooth pair or a flank changes, and its solver has to find that out.

The state y holds x [m] of all bodies less that at the start, in a frame that turns uniformly at the
speeds the motors start with; then v [m/s] and the integral of each motor's speed error [rad], so
that nothing drifts and nothing that is much larger than it varies loosens a relative tolerance.
"""

from __future__ import annotations

import math

import numpy as np

from ..._compile import allocating, kernel
from ..._records import Record, layout
from ...dynamics.body_speed import body_speed
from ...dynamics.contact_events import departure
from ...dynamics.cycle import cycle_shift, find_segment, frame_cycle
from ...dynamics.equations import EVALUATION, MODEL, forces
from ...dynamics.faults import find_faults
from ...dynamics.mesh_force import deflection
from ...dynamics.moment import MOMENT, set_moment, take_segment
from ...dynamics.observe import DTE, POWER_LOSS, QUANTITIES, observe
from ...dynamics.state import COAST_SIDE, DRIVE_SIDE, OPEN, STATE

# A model, its start, and room for one evaluation.
PROBLEM = layout(model=MODEL, start=STATE, state=STATE, moment=MOMENT, evaluation=EVALUATION)


@kernel
def place(problem: Record, t: float, y: np.ndarray) -> None:
    """Fill `state` and `moment` with what y is at time t [s]."""
    train, load = problem.model.train, problem.model.load
    start, state = problem.start, problem.state
    for j in range(train.bodies):
        state.x[j] = start.x[j] + y[j]
        state.v[j] = start.v[j] + y[train.bodies + j]
    for a in range(train.axes):
        state.trim[a] = start.trim[a] + y[2 * train.bodies + a]
        state.speed[a] = start.speed[a]
        turn = start.fraction[a] + start.speed[a] * t / (2.0 * math.pi)
        state.turns[a] = start.turns[a] + math.floor(turn)
        state.fraction[a] = turn - math.floor(turn)
        gap, slewed = load.target_speed[a] - start.set_speed[a], load.slew_rate * t
        state.set_speed[a] = start.set_speed[a] + max(-slewed, min(gap, slewed))
    for i in range(train.meshes):
        state.side[i] = OPEN
    set_moment(problem.model, state, problem.moment)
    _touch(problem)


@kernel
def _touch(problem: Record) -> None:
    """Find the flanks in contact and the segments of their tooth pairs."""
    model, state, moment = problem.model, problem.state, problem.moment
    train, x, v = model.train, state.x, state.v
    pace = moment.cycle_rate + cycle_shift(train, v)
    cycles = frame_cycle(train, state, 1) + cycle_shift(train, x)
    for i in range(train.meshes):
        if departure(model, state, moment, i, x, v, (0.0, pace, 0.0)) >= 0.0:
            continue
        d = deflection(train, moment, i, x, v, 0.0, pace)[0]
        side = DRIVE_SIDE if d > 0.0 else COAST_SIDE
        # As `mesh_cycle`, but the cycles of the frame, which take long to count, are counted once.
        cycle = side * (cycles - train.phase[i]) + (0.5 if side == COAST_SIDE else 0.0)
        cycle -= math.floor(cycle)
        state.side[i] = side
        state.segment[i] = find_segment(train, train.kind[i], cycle, side * pace)
        take_segment(train, state, moment, i)
        moment.start[i] = cycle
        if train.faults > 0:
            find_faults(train, state, i, side, cycle, moment.faulty)


@kernel
def derivative(problem: Record, t: float, y: np.ndarray, dy: np.ndarray) -> None:
    """Fill dy/dt at time t [s]."""
    place(problem, t, y)
    model, state, evaluation = problem.model, problem.state, problem.evaluation
    train, n = model.train, model.train.bodies
    forces(model, state, problem.moment, state.x, state.v, 0.0, state.trim, evaluation)
    for j in range(n):
        dy[j] = state.v[j]
        dy[n + j] = evaluation.force[j] / train.mass[j]
    for a in range(train.axes):
        motor = train.coupling[2 * a, 0]
        dy[2 * n + a] = state.set_speed[a] - body_speed(train, state, state.v, motor)


@kernel
def rate(problem: np.ndarray, t: float, y: np.ndarray, dy: np.ndarray) -> None:
    """`derivative` of a problem in an array (1,), which reaches a kernel 60 times faster."""
    derivative(problem[0], t, y, dy)


@kernel
def repeat(problem: np.ndarray, step: float, y: np.ndarray, dy: np.ndarray, count: int) -> None:
    """Call `derivative` at `count` times, `step` seconds apart."""
    for k in range(count):
        derivative(problem[0], k * step, y, dy)


@allocating
def show(problem: np.ndarray, times: np.ndarray, states: np.ndarray, out: np.ndarray) -> float:
    """Fill out[k, i] with the transmission error [m] of mesh i in state k; mean power loss [W]."""
    own, lost = problem[0], 0.0
    room = np.empty((QUANTITIES, own.model.train.meshes))
    for k in range(len(times)):
        place(own, times[k], states[k])
        x, v = own.state.x, own.state.v
        observe(own.model, own.state, own.moment, x, v, 0.0, own.evaluation, room)
        out[k] = room[DTE]
        lost += room[POWER_LOSS].sum()
    return lost / len(times)
