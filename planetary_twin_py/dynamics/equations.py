"""Equations of motion: forces on every body, and the powers of the energy ledger.

J_s th_s'' = T_s - r_bs sum F_sp + Q_s and so on for every body (Salagianni et al. 2017, eqs.
(18)-(20), with friction as the generalised force Q_j = -f dVs/dw_j instead of P/w). In the
coordinates x = r theta all mesh forces enter with the signs of `TRAIN.sign`.
"""

from __future__ import annotations

import math

import numpy as np

from .._compile import kernel
from .._records import BODIES, REAL, Record, layout
from .bodies import MOTOR
from .body_speed import body_speed
from .cycle import cycle_shift
from .mesh_force import press
from .oil import OIL
from .state import (
    DAMPING,
    FRICTION,
    IMPULSE,
    LEDGER,
    LOAD,
    OPEN,
    STIFFNESS_WORK,
    WORK,
)
from .tooth_friction import (
    TOOTH_PAIRS,
    apply_friction,
    apply_printed_friction,
    apply_rolling,
    evaluate,
)
from .train import TRAIN

# All that the equations of motion read.
MODEL = layout(train=TRAIN, oil=OIL, load=LOAD)

# What one evaluation of the equations writes.
EVALUATION = layout(
    force=(REAL, (BODIES,)),  # [N]
    power=(REAL, (LEDGER,)),  # integrands of the energy ledger [W]
    pairs=TOOTH_PAIRS,
)


@kernel
def begin_pairs(
    train: Record,
    state: Record,
    moment: Record,
    x: np.ndarray,
    v: np.ndarray,
    delay: float,
    pairs: Record,
) -> None:
    """Empty `pairs`; note where the meshes stand `delay` seconds after the start of a step."""
    pairs.count = 0
    pairs.advance = moment.cycle_rate * delay + cycle_shift(train, x) - cycle_shift(train, state.x)
    pairs.pace = moment.cycle_rate + cycle_shift(train, v)


@kernel
def forces(
    model: Record,
    state: Record,
    moment: Record,
    x: np.ndarray,
    v: np.ndarray,
    delay: float,
    trim: np.ndarray,
    out: Record,
) -> None:
    """Forces on all bodies in coordinates x, `delay` seconds after the start of a step.

    `state` gives the sides in contact, the segments and x at the start.
    """
    train, force, power, pairs = model.train, out.force, out.power, out.pairs
    force[:] = 0.0
    power[:] = 0.0
    begin_pairs(train, state, moment, x, v, delay, pairs)
    pairs.wanted = train.friction or train.faults > 0
    for i in range(train.meshes):
        side = state.side[i]
        if side == OPEN:
            continue
        push, lost, work = press(model, state, moment, i, x, v, pairs)
        for j in range(3):
            force[train.body[i, j]] -= side * push * train.sign[i, j]
        power[DAMPING] += lost
        power[STIFFNESS_WORK] += work
    if not train.friction:
        pairs.count = 0
    elif pairs.count > 0:
        evaluate(model, pairs)
        if train.printed_torque:
            power[FRICTION] = apply_printed_friction(train, state, v, pairs, force)
        else:
            power[FRICTION] = apply_friction(train, pairs, force)
        if model.oil.rolling:
            power[FRICTION] += apply_rolling(train, pairs, force)
    _couplings(train, x, v, out)
    _machines(model, state, moment, x, v, delay, trim, out)
    force[train.bodies] = 0.0  # the ground


@kernel
def _couplings(train: Record, x: np.ndarray, v: np.ndarray, out: Record) -> None:
    """Shafts between the machines and their members."""
    for c in range(train.machines):
        machine, member = train.coupling[c, 0], train.coupling[c, 1]
        rate = v[machine] - v[member]
        damping = train.coupling_damping[c] * rate
        total = train.coupling_stiffness[c] * (x[machine] - x[member]) + damping
        out.force[machine] -= total
        out.force[member] += total
        out.power[DAMPING] += damping * rate


@kernel
def _machines(
    model: Record,
    state: Record,
    moment: Record,
    x: np.ndarray,
    v: np.ndarray,
    delay: float,
    trim: np.ndarray,
    out: Record,
) -> None:
    """Torques of the motors, which keep their speeds, and of the load."""
    train, load = model.train, model.load
    for c in range(train.machines):
        body = train.coupling[c, 0]
        speed = body_speed(train, state, v, body)
        torque = load.torque[c]
        for a in range(train.axes):
            torque += load.trim_gain[c, a] * trim[a]
        if c % 2 == 0:  # a motor
            own = c // 2
            set_speed = state.set_speed[own] + moment.slew[own] * delay
            torque += load.proportional[own] * (set_speed - speed)
            for a in range(train.axes):
                torque += load.inertia[own, a] * moment.slew[a]
        if c == MOTOR:
            angle = 2.0 * math.pi * state.fraction[0] + state.speed[0] * delay
            angle += x[body] / train.radius[body]
            torque += load.ripple * math.sin(load.ripple_order * angle)
        out.force[body] += torque / train.radius[body]
        out.power[WORK + c] = torque * speed
        out.power[IMPULSE + c] = torque
