"""Equations of motion: forces on every body, and the powers of the energy ledger.

J_s th_s'' = T_s - r_bs sum F_sp + Q_s and so on for every body (Salagianni et al. 2017, eqs.
(18)-(20), with friction as the generalised force Q_j = -f dVs/dw_j instead of P/w). In the
coordinates x = r theta all mesh forces enter with the signs of `TRAIN.sign`.
"""

from __future__ import annotations

import math

import numpy as np

from .._compile import kernel
from .._overwrite import copy_array
from .._records import BODIES, REAL, Record, layout
from .bodies import MOTOR
from .body_speed import body_speed
from .drag import apply_drag
from .mesh_force import MESHES_NOW, move_meshes, place_meshes, press, press_faulty, spread
from .oil import OIL
from .state import DAMPING, FRICTION, IMPULSE, LEDGER, LOAD, WORK
from .tooth_friction import (
    DRAG_OF_MESHES,
    TOOTH_PAIRS,
    collect,
    collect_printed,
    evaluate,
    turn_pairs,
)
from .train import TRAIN

# All that the equations of motion read.
MODEL = layout(train=TRAIN, oil=OIL, load=LOAD)

# What one evaluation of the equations writes.
EVALUATION = layout(
    force=(REAL, (BODIES,)),  # [N]
    rubbing=(REAL, (BODIES,)),  # friction and drag alone [N]
    power=(REAL, (LEDGER,)),  # integrands of the energy ledger [W]
    now=MESHES_NOW,
    pairs=TOOTH_PAIRS,
    dragging=DRAG_OF_MESHES,
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
    move_meshes(model.train, x, v, out.now)
    squeeze(model, state, moment, x, v, delay, out)
    rub(model, state, moment, v, out)
    drive(model, state, moment, x, v, delay, trim, out)


@kernel
def squeeze(
    model: Record,
    state: Record,
    moment: Record,
    x: np.ndarray,
    v: np.ndarray,
    delay: float,
    out: Record,
) -> None:
    """Pushes of the meshes, whose transmission errors are known."""
    train, now = model.train, out.now
    out.power[:] = 0.0
    place_meshes(train, state, moment, x, v, delay, now)
    if train.faults > 0:
        press_faulty(model, state, moment, now, out.pairs, out.power)
    else:
        press(model, moment, now, out.power)


@kernel
def share_loads(model: Record, moment: Record, out: Record) -> None:
    """Share the pushes among the tooth pairs, where that is not done yet."""
    if model.train.faults == 0:
        spread(model, moment, out.now, out.pairs)


@kernel
def rub(model: Record, state: Record, moment: Record, v: np.ndarray, out: Record) -> None:
    """Friction and drag."""
    train, pairs, dragging = model.train, out.pairs, out.dragging
    out.rubbing[:] = 0.0
    if train.friction:
        share_loads(model, moment, out)
        turn_pairs(train, moment, v, pairs)
        evaluate(model, pairs)
        if train.printed_torque:
            collect_printed(train, moment, v, pairs, dragging)
        else:
            collect(train, pairs, dragging)
        for i in range(train.meshes):
            copies = train.copies[i]
            out.power[FRICTION] += copies * dragging.power[i]
            for j in range(3):
                force = dragging.torque[j, i] * train.lever[j, i]
                out.rubbing[train.body[i, j]] += copies * force
    if train.joints + train.discs > 0:
        apply_drag(model, state, v, out)


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
    """All forces together: pushes of the meshes, friction and drag, couplings, machines."""
    train = model.train
    copy_array(out.force, out.rubbing)
    for i in range(train.meshes):
        push = train.copies[i] * state.side[i] * out.now.push[i]
        for j in range(3):
            out.force[train.body[i, j]] -= push * train.sign[i, j]
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
        if c == MOTOR and load.ripple != 0.0:
            angle = 2.0 * math.pi * state.fraction[0] + state.speed[0] * delay
            angle += x[body] / train.radius[body]
            torque += load.ripple * math.sin(load.ripple_order * angle)
        out.force[body] += torque / train.radius[body]
        out.power[WORK + c] = torque * speed
        out.power[IMPULSE + c] = torque
