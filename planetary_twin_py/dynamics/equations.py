"""Equations of motion: forces on every body, and the powers of the energy ledger.

J_s th_s'' = T_s - r_bs sum F_sp + Q_s and so on for every body (Salagianni et al. 2017, eqs.
(18)-(20), with friction as the generalised force Q_j = -f dVs/dw_j instead of P/w). In the
coordinates x = r theta all mesh forces enter with the signs of `TRAIN.sign`.
"""

from __future__ import annotations

import math

import numpy as np

from .._compile import kernel
from .._records import BODIES, MESHES, REAL, WHOLE, Record, layout
from .bodies import MOTOR
from .body_speed import body_speed
from .cycle import cycle_shift
from .drag import apply_drag
from .mesh_force import press
from .moment import damping_time
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
    rubbing=(REAL, (BODIES,)),  # friction and drag alone [N]
    power=(REAL, (LEDGER,)),  # integrands of the energy ledger [W]
    push=(REAL, (MESHES,)),  # of every mesh, 0 if open [N]
    first_pair=WHOLE,  # its tooth pairs in a TOOTH_PAIRS
    end_pair=WHOLE,
    pairs=TOOTH_PAIRS,
)


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
    train = model.train
    begin_pairs(train, train.friction, out.pairs)
    squeeze(model, state, moment, x, v, delay, out, out.pairs)
    if train.friction:
        evaluate(model, out.pairs)
    rub(model, state, v, out, out.pairs)
    drive(model, state, moment, x, v, delay, trim, out)


@kernel
def begin_pairs(train: Record, wanted: bool, pairs: Record) -> None:
    """Empty `pairs`; faulty meshes need them in any case."""
    pairs.count = 0
    pairs.wanted = wanted or train.faults > 0


@kernel
def place_pairs(
    train: Record,
    state: Record,
    moment: Record,
    x: np.ndarray,
    v: np.ndarray,
    delay: float,
    pairs: Record,
) -> None:
    """Note where the meshes stand `delay` seconds after the start of a step."""
    pairs.advance = moment.cycle_rate * delay + cycle_shift(train, x) - cycle_shift(train, state.x)
    pairs.pace = moment.cycle_rate + cycle_shift(train, v)
    for kind in range(2):
        pairs.tau[kind] = damping_time(train, moment, v, kind)


@kernel
def squeeze(
    model: Record,
    state: Record,
    moment: Record,
    x: np.ndarray,
    v: np.ndarray,
    delay: float,
    out: Record,
    pairs: Record,
) -> None:
    """Forces of the meshes; their tooth pairs are appended to `pairs` if those are wanted.

    The first part of `forces`: the pairs of several instants can be evaluated side by side.
    """
    train, force, power = model.train, out.force, out.power
    force[:] = 0.0
    power[:] = 0.0
    place_pairs(train, state, moment, x, v, delay, pairs)
    out.first_pair = pairs.count
    for i in range(train.meshes):
        side = state.side[i]
        if side == OPEN:
            out.push[i] = 0.0
            continue
        push, lost, work = press(model, state, moment, i, x, v, pairs)
        for j in range(3):
            force[train.body[i, j]] -= side * push * train.sign[i, j]
        out.push[i] = push
        power[DAMPING] += lost
        power[STIFFNESS_WORK] += work
    out.end_pair = pairs.count


@kernel
def rub(model: Record, state: Record, v: np.ndarray, out: Record, pairs: Record) -> None:
    """Add friction and drag to the forces of the meshes."""
    train, force, power = model.train, out.rubbing, out.power
    force[:] = 0.0
    span = (out.first_pair, out.end_pair if train.friction else out.first_pair)
    if train.printed_torque:
        power[FRICTION] = apply_printed_friction(train, state, v, pairs, span, force)
    else:
        power[FRICTION] = apply_friction(train, pairs, span, force)
    if model.oil.rolling:
        power[FRICTION] += apply_rolling(train, pairs, span, force)
    if train.bearings + train.discs > 0:
        apply_drag(model, state, v, out)
    out.force[:] += force


@kernel
def drive(
    model: Record,
    state: Record,
    moment: Record,
    x: np.ndarray,
    v: np.ndarray,
    delay: float,
    trim: np.ndarray,
    out: Record,
) -> None:
    """Add the couplings and the machines."""
    _couplings(model.train, x, v, out)
    _machines(model, state, moment, x, v, delay, trim, out)
    out.force[model.train.bodies] = 0.0  # the ground


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
