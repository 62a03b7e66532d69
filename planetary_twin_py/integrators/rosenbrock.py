"""One step of ROS34PW2, a linearly implicit Runge-Kutta method of order 3.

Rang and Angermann 2005, New Rosenbrock W-methods of order 3 for partial differential algebraic
equations of index 1, BIT 45, 761-787. A W-method: its order does not need the exact Jacobian, so
the matrix holds meshes, couplings and the growth of friction with sliding, but neither the
change of friction with the load nor the speed loop.
L-stable, which the damping of a mesh at low speed asks for, and stiffly accurate.

The second-order form halves the linear system: with x' = v, stages need one Cholesky
factorisation of M/(gamma h) + C + gamma h K per step.
"""

from __future__ import annotations

import numpy as np

from .._cholesky import factorise, solve
from .._compile import kernel
from .._overwrite import copy_array
from .._records import AXES, BODIES, MACHINES, REAL, Record, layout
from ..dynamics.body_speed import body_speed
from ..dynamics.cycle import cycle_shift
from ..dynamics.equations import EVALUATION, forces
from ..dynamics.mesh_force import mesh_stiffness, push_drift
from ..dynamics.state import IMPULSE, LEDGER, OPEN, ROOM, WORK
from ..dynamics.tooth_friction import add_outer, friction_damping
from .bristle_stage import bend_bristles, bristle_damping, pull_bristles, solve_bristles

ORDER = 3
STAGES = 4
GAMMA = 4.3586652150845900e-01

_ALPHA = np.array(
    [
        [0.0, 0.0, 0.0, 0.0],
        [8.7173304301691801e-01, 0.0, 0.0, 0.0],
        [8.4457060015369423e-01, -1.1299064236484185e-01, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
    ]
)
_GAMMAS = np.array(
    [
        [GAMMA, 0.0, 0.0, 0.0],
        [-8.7173304301691801e-01, GAMMA, 0.0, 0.0],
        [-9.0338057013044082e-01, 5.4180672388095326e-02, GAMMA, 0.0],
        [2.4212380706095346e-01, -1.2232505839045147e00, 5.4526025533510214e-01, GAMMA],
    ]
)
_B = np.array([2.4212380706095346e-01, -1.2232505839045147e00, 1.5452602553351020e00, GAMMA])
_B_EMBEDDED = np.array(
    [3.7810903145819369e-01, -9.6042292212423178e-02, 5.0e-01, 2.1793326075422950e-01]
)

# The usual transformation that avoids products with the Jacobian (Hairer and Wanner, Solving
# Ordinary Differential Equations II, section IV.7): stages u = Gamma k.
_INVERSE = np.linalg.inv(_GAMMAS)
A = _ALPHA @ _INVERSE
C = np.eye(STAGES) / GAMMA - _INVERSE
WEIGHT = _B @ _INVERSE
ERROR_WEIGHT = WEIGHT - _B_EMBEDDED @ _INVERSE
# Quantities without a place in the Jacobian (trim, ledger) use the stages as they are.
ALPHA = _ALPHA
B = _B
ABSCISSA = _ALPHA.sum(axis=1)
DRIFT_WEIGHT = _GAMMAS.sum(axis=1)


# Room for one step, and what it leaves behind besides the new state.
WORKSPACE = layout(
    ux=(REAL, (STAGES, BODIES)),
    uv=(REAL, (STAGES, BODIES)),
    x=(REAL, (BODIES,)),  # of a stage
    v=(REAL, (BODIES,)),
    rx=(REAL, (BODIES,)),  # right-hand sides
    rv=(REAL, (BODIES,)),
    trim=(REAL, (AXES,)),  # of a stage
    trim_rate=(REAL, (STAGES, AXES)),
    stiffness=(REAL, (BODIES, BODIES)),  # K
    system=(REAL, (BODIES, BODIES)),  # factorised
    row=(REAL, (3,)),  # of the friction of a tooth pair
    drift=(REAL, (BODIES,)),  # of the forces with time at rest [N/s]
    evaluation=EVALUATION,  # of the stage at hand
    error_x=(REAL, (BODIES,)),  # local error of x [m]
    error_v=(REAL, (BODIES,)),  # local error of v [m/s]
    bend=(REAL, (STAGES, ROOM)),  # stages of the shares of friction of pairs that hold
    error_bristle=(REAL, (ROOM,)),  # local error of those
    energy=(REAL, (LEDGER,)),  # growth of the ledger in this step [J]
    way=(REAL, (MACHINES,)),  # of the machines, by the quadrature that fills the ledger [m]
)


_ENDS = np.array([1.0, -1.0])


@kernel
def _assemble(
    model: Record, state: Record, moment: Record, h: float, first: Record, work: Record
) -> None:
    """K, and M/(gamma h) + C + gamma h K, of the contacts at the middle of the step."""
    train = model.train
    step = GAMMA * h
    pace = moment.cycle_rate + cycle_shift(train, state.v)
    work.stiffness[:] = 0.0
    work.system[:] = 0.0
    work.drift[:] = 0.0
    for i in range(train.meshes):
        side = state.side[i]
        if side == OPEN:
            continue
        kind = train.kind[i]
        copies = train.copies[i]
        drift = copies * push_drift(model, state, moment, i, pace)
        for j in range(3):
            work.drift[train.body[i, j]] -= side * drift * train.sign[i, j]
        cycle = moment.start[i] + side * pace * 0.5 * h
        k = copies * mesh_stiffness(train, kind, state.segment[i], cycle)
        add_outer(work.stiffness, train.body[i], train.sign[i], k)
        add_outer(work.system, train.body[i], train.sign[i], k * (moment.tau[kind] + step))
    for c in range(train.machines):
        k = train.coupling_stiffness[c]
        add_outer(work.stiffness, train.coupling[c], _ENDS, k)
        add_outer(work.system, train.coupling[c], _ENDS, train.coupling_damping[c] + step * k)
    if train.friction:
        if first.pairs.held:
            bristle_damping(train, first.pairs, step, work.row, work.system)
        else:
            friction_damping(train, first.pairs, first.force, h, work.row, work.system)
    for j in range(train.bodies + 1):
        work.system[j, j] += train.mass[j] / step


@kernel
def _stage(
    model: Record,
    state: Record,
    moment: Record,
    h: float,
    i: int,
    first: Record,
    work: Record,
) -> None:
    """Stage i: evaluate, then solve for ux[i] and uv[i]."""
    train = model.train
    bodies = train.bodies + 1
    g = 1.0 / (GAMMA * h)
    for j in range(bodies):
        x, v, cx, cv = state.x[j], state.v[j], 0.0, 0.0
        for s in range(i):
            x += A[i, s] * work.ux[s, j]
            v += A[i, s] * work.uv[s, j]
            cx += C[i, s] * work.ux[s, j]
            cv += C[i, s] * work.uv[s, j]
        work.x[j], work.v[j] = x, v
        work.rx[j] = v + cx / h
        work.rv[j] = train.mass[j] * cv / h
    for a in range(train.axes):
        work.trim[a] = state.trim[a]
        for s in range(i):
            work.trim[a] += h * ALPHA[i, s] * work.trim_rate[s, a]
    out = first if i == 0 else work.evaluation
    if i > 0:
        bend_bristles(out.pairs, state.bristle, A[i], work.bend, i)
        forces(model, state, moment, work.x, work.v, ABSCISSA[i] * h, work.trim, out)
    for a in range(train.axes):
        speed = body_speed(train, state, work.v, train.coupling[2 * a, 0])
        set_speed = state.set_speed[a] + moment.slew[a] * ABSCISSA[i] * h
        work.trim_rate[i, a] = set_speed - speed
    for e in range(LEDGER):
        work.energy[e] += h * B[i] * out.power[e]
    for c in range(train.machines):
        work.way[c] += h * B[i] * work.v[train.coupling[c, 0]]
    right = work.uv[i]
    for j in range(bodies):
        value = out.force[j] + work.rv[j] + h * DRIFT_WEIGHT[i] * work.drift[j]
        for k in range(bodies):
            value -= work.stiffness[j, k] * work.rx[k] / g
        right[j] = value
    if first.pairs.held:
        pull_bristles(train, first.pairs, out.pairs, (h, GAMMA * h), C[i], i, right, work)
    solve(work.system, bodies - 1, right)
    right[bodies - 1] = 0.0
    for j in range(bodies):
        work.ux[i, j] = (work.rx[j] + right[j]) / g
    work.ux[i, bodies - 1] = 0.0
    if first.pairs.held:
        solve_bristles(train, first.pairs, GAMMA * h, right, i, work)


@kernel
def step(
    model: Record,
    state: Record,
    moment: Record,
    h: float,
    first: Record,
    new: Record,
    work: Record,
) -> None:
    """Advance x, v and trim of `state` by h seconds into `new`.

    `first` holds the forces at the start. The growth of the energy ledger and the local errors
    are left in `work`. Sides and segments stay those of `state`.
    """
    _assemble(model, state, moment, h, first, work)
    factorise(work.system, model.train.bodies)
    work.energy[:] = work.way[:] = 0.0
    copy_array(new.x, state.x)
    copy_array(new.v, state.v)
    work.error_x[:] = 0.0
    work.error_v[:] = 0.0
    work.error_bristle[:] = 0.0
    copy_array(new.bristle, state.bristle)
    copy_array(new.trim, state.trim)
    for i in range(STAGES):
        _stage(model, state, moment, h, i, first, work)
        for a in range(model.train.axes):
            new.trim[a] += h * B[i] * work.trim_rate[i, a]
        for j in range(model.train.bodies + 1):
            new.x[j] += WEIGHT[i] * work.ux[i, j]
            new.v[j] += WEIGHT[i] * work.uv[i, j]
            work.error_x[j] += ERROR_WEIGHT[i] * work.ux[i, j]
            work.error_v[j] += ERROR_WEIGHT[i] * work.uv[i, j]
        if first.pairs.held:
            for k in range(first.pairs.count):
                new.bristle[k] += WEIGHT[i] * work.bend[i, k]
                work.error_bristle[k] += ERROR_WEIGHT[i] * work.bend[i, k]
    _work_over_the_way(model.train, state, h, new, work)


@kernel
def _work_over_the_way(train: Record, state: Record, h: float, new: Record, work: Record) -> None:
    """Let the machines do their work over the way that the step makes.

    A shaft is wound up by far more than it swings: what its end is wrong by, times all of its
    torque, would be missing in the ledger, though both ends of the shaft agree on it.
    """
    for c in range(train.machines):
        body = train.coupling[c, 0]
        force = work.energy[IMPULSE + c] / (h * train.radius[body])
        work.energy[WORK + c] += force * (new.x[body] - state.x[body] - work.way[c])
