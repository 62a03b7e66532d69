"""Equations of motion: forces on every body, and the powers of the energy ledger.

J_s th_s'' = T_s - r_bs sum F_sp + Q_s and so on for every body (Salagianni et al. 2017, eqs.
(18)-(20), with friction as the generalised force Q_j = -f dVs/dw_j instead of P/w). In the
coordinates x = r theta all mesh forces enter with the signs of `TRAIN.sign`.
"""

from __future__ import annotations

import math

import numpy as np

from .._compile import kernel
from .._records import BODIES, MESHES, REAL, Record, layout
from ..mesh.tooth_pairs import PAIRS
from .oil import OIL
from .state import (
    DAMPING,
    FRICTION,
    INPUT,
    LEDGER,
    LOAD,
    LOAD_IMPULSE,
    MOTOR_IMPULSE,
    OPEN,
    OUTPUT,
    STIFFNESS_WORK,
)
from .tooth_friction import TOOTH_PAIRS, apply_friction, evaluate, gather
from .train import TRAIN

# All that the equations of motion read.
MODEL = layout(train=TRAIN, oil=OIL, load=LOAD)

# Mesh quantities that hold during one step.
MOMENT = layout(
    start=(REAL, (MESHES,)),  # fraction of the mesh cycle at the start of the step
    tau=(REAL, (2,)),  # damping time of each kind of mesh [s]
    cycle_rate=REAL,  # mesh cycles per second of the frame, signed
    slew=REAL,  # of the speed set-point [rad/s^2]
)

# What one evaluation of the equations writes.
EVALUATION = layout(
    force=(REAL, (BODIES,)),  # [N]
    power=(REAL, (LEDGER,)),  # integrands of the energy ledger [W]
    pairs=TOOTH_PAIRS,
)


@kernel
def damping_time(train: Record, kind: int, speed: float) -> float:
    """tau [s] of c = tau k at a motor speed [rad/s]."""
    frequency = max(abs(train.cycles * speed) / (2.0 * math.pi), train.lowest_frequency)
    return train.damping_time[kind] + train.damping_cycles / frequency


@kernel
def cycle_shift(train: Record, x: np.ndarray) -> float:
    """Mesh cycles by which the train is ahead of the rigid frame."""
    return train.sun_advance * x[train.sun] + train.carrier_advance * x[train.carrier]


@kernel
def stiffness(train: Record, kind: int, segment: int, cycle: float) -> float:
    """Mesh stiffness [N/m] at a fraction of the mesh cycle."""
    weight = 0.0
    for p in range(PAIRS):
        weight += train.offset[kind, segment, p] + train.slope[kind, segment, p] * cycle
    return train.stiffness[kind] * (1.0 + train.pair_gain * (weight - 1.0))


@kernel
def mesh_motion(train: Record, i: int, x: np.ndarray) -> float:
    """Transmission error of mesh i from x, its rate from v."""
    total = 0.0
    for j in range(3):
        total += train.sign[i, j] * x[train.body[i, j]]
    return total


@kernel
def forces(
    model: Record,
    state: Record,
    moment: Record,
    x: np.ndarray,
    v: np.ndarray,
    delay: float,
    trim: float,
    out: Record,
) -> None:
    """Forces on all bodies in coordinates x, `delay` seconds after the start of a step.

    `state` gives the sides in contact, the segments and x at the start.
    """
    train, force, power, pairs = model.train, out.force, out.power, out.pairs
    ground = train.bodies
    force[:] = 0.0
    power[:] = 0.0
    advance = moment.cycle_rate * delay + cycle_shift(train, x) - cycle_shift(train, state.x)
    pace = moment.cycle_rate + cycle_shift(train, v)
    pairs.count = 0
    for i in range(train.meshes):
        side = state.side[i]
        if side == OPEN:
            continue
        kind, segment = train.kind[i], state.segment[i]
        cycle = moment.start[i] + side * advance
        k = stiffness(train, kind, segment, cycle)
        squeeze = side * mesh_motion(train, i, x) - model.load.half_backlash
        closing = side * mesh_motion(train, i, v)
        damping = moment.tau[kind] * k * closing
        total = k * squeeze + damping
        for j in range(3):
            force[train.body[i, j]] -= side * total * train.sign[i, j]
        power[DAMPING] += damping * closing
        slope = 0.0
        for p in range(PAIRS):
            slope += train.slope[kind, segment, p]
        growth = train.stiffness[kind] * train.pair_gain * slope * side * pace
        power[STIFFNESS_WORK] += 0.5 * growth * squeeze * squeeze
        if train.friction:
            gather(model, state, i, cycle, max(total, 0.0), v, pairs)
    if pairs.count > 0:
        evaluate(model, pairs)
        power[FRICTION] = apply_friction(train, pairs, force)
    _machines(model, state, moment, x, v, delay, trim, out)
    force[ground] = 0.0


@kernel
def _machines(
    model: Record,
    state: Record,
    moment: Record,
    x: np.ndarray,
    v: np.ndarray,
    delay: float,
    trim: float,
    out: Record,
) -> None:
    """Couplings, the motor's torque and the load's."""
    train, load, force, power = model.train, model.load, out.force, out.power
    for c in range(2):
        machine, member = train.coupling[c, 0], train.coupling[c, 1]
        rate = v[machine] - v[member]
        damping = train.coupling_damping[c] * rate
        total = train.coupling_stiffness[c] * (x[machine] - x[member]) + damping
        force[machine] -= total
        force[member] += total
        power[DAMPING] += damping * rate
    motor, brake = train.coupling[0, 0], train.coupling[1, 0]
    speed = state.speed + v[motor] / train.radius[motor]
    brake_speed = train.ratio[brake] * state.speed + v[brake] / train.radius[brake]
    set_speed = state.set_speed + moment.slew * delay
    angle = 2.0 * math.pi * state.fraction + state.speed * delay
    angle += x[motor] / train.radius[motor]
    torque = (
        load.torque
        + load.ripple * math.sin(load.ripple_order * angle)
        + load.inertia * moment.slew
        + load.proportional * (set_speed - speed)
    )
    brake_torque = load.output_gain * (load.torque - load.integral * trim)
    force[motor] += torque / train.radius[motor]
    force[brake] += brake_torque / train.radius[brake]
    power[INPUT] = torque * speed
    power[OUTPUT] = -brake_torque * brake_speed
    power[MOTOR_IMPULSE] = torque
    power[LOAD_IMPULSE] = brake_torque
