"""The force of one mesh, shared among its tooth pairs.

A closed mesh is squeezed by q = d - e - b on its side, d the transmission error, e the error of
form, b half the backlash. A pair of stiffness k pushes with k (q + tau q'), Salagianni et al. 2017,
(4), (5), (14) along the line of action; a worn pair only when q has passed its missing material.
"""

from __future__ import annotations

import numpy as np

from .._compile import kernel, law
from .._records import Record
from ..mesh.tooth_pairs import TOTAL
from .body_speed import body_speed
from .form_errors import form_error, form_error_bend
from .moment import place_mesh
from .state import OPEN

LINEAR = 2  # terms


@law
def mesh_motion(train: Record, i: int, x: np.ndarray) -> float:
    """Transmission error of mesh i from x, its rate from v."""
    total = 0.0
    for j in range(3):
        total += train.sign[i, j] * x[train.body[i, j]]
    return total


@law
def deflection(
    train: Record,
    moment: Record,
    i: int,
    x: np.ndarray,
    v: np.ndarray,
    advance: float,
    pace: float,
) -> tuple[float, float, float]:
    """d - e [m] of mesh i, its rate, and the rate of e [m/s]."""
    d, rate = mesh_motion(train, i, x), mesh_motion(train, i, v)
    if train.lines[train.kind[i]] == 0:
        return d, rate, 0.0
    e, e_rate = form_error(train, i, moment.line_angle, advance, pace)
    return d - e, rate - e_rate, e_rate


@law
def polynomial(
    table: np.ndarray, kind: int, segment: int, pair: int, u: float, terms: int
) -> tuple[float, float]:
    """A tabulated polynomial and its derivative at `u` cycles into a segment."""
    slope = table[kind, segment, pair, 1]
    value = table[kind, segment, pair, 0] + slope * u
    if terms == LINEAR:  # what a given stiffness needs
        return value, slope
    value = slope = 0.0
    for n in range(terms - 1, -1, -1):
        slope = slope * u + value
        value = value * u + table[kind, segment, pair, n]
    return value, slope


@law
def total_weight(train: Record, kind: int, segment: int, u: float) -> tuple[float, float]:
    """Sum of the weights of the tooth pairs of a mesh, and its growth per cycle."""
    return polynomial(train.weight, kind, segment, TOTAL, u, train.terms)


@law
def mesh_stiffness(train: Record, kind: int, segment: int, cycle: float) -> float:
    """Stiffness [N/m] of a mesh without faults at a fraction of its cycle."""
    total = total_weight(train, kind, segment, cycle - train.edge[kind, segment])[0]
    return train.stiffness_base[kind] + train.stiffness_gain[kind] * total


@kernel
def fault_effect(
    train: Record, moment: Record, i: int, segment: int, pair: int, u: float
) -> tuple[float, float, float]:
    """Factor on the stiffness of a tooth pair, its growth per cycle, and missing material [m]."""
    factor, growth, gap = 1.0, 0.0, 0.0
    for f in range(train.faults):
        if moment.faulty[i, pair, f]:
            value, slope = polynomial(
                train.fault_factor[f], train.kind[i], segment, pair, u, train.weight.shape[-1]
            )
            growth = growth * value + factor * slope
            factor *= value
            gap += train.fault_gap[f]
    return factor, growth, gap


@law
def append_pairs(
    train: Record, state: Record, i: int, cycle: float, total: float, v: np.ndarray, pairs: Record
) -> int:
    """Append the tooth pairs of mesh i at a fraction of its cycle, with their share of its load.

    Returns the place of the first.
    """
    kind, segment, begin = train.kind[i], state.segment[i], pairs.count
    frame = body_speed(train, state, v, train.body[i, 2])
    speed1 = body_speed(train, state, v, train.body[i, 0]) - frame
    speed2 = body_speed(train, state, v, train.body[i, 1]) - frame
    u, inverse = cycle - train.edge[kind, segment], 1.0 / total
    for p in range(train.present[kind, segment]):
        n = begin + p
        s = (cycle + train.shift[kind, segment, p]) * train.base_pitch
        weight, slope = polynomial(train.weight, kind, segment, p, u, train.terms)
        pairs.mesh[n] = i
        pairs.share[n] = weight * inverse
        pairs.growth[n] = slope * inverse
        pairs.rho1[n] = train.pitch_curvature[kind, 0] + s
        pairs.rho2[n] = train.pitch_curvature[kind, 1] - train.external[kind] * s
        pairs.external[n] = train.external[kind]
        pairs.speed1[n] = speed1
        pairs.speed2[n] = speed2
    pairs.count += train.present[kind, segment]
    return begin


@law
def press(
    model: Record,
    state: Record,
    moment: Record,
    i: int,
    x: np.ndarray,
    v: np.ndarray,
    pairs: Record,
) -> tuple[float, float, float]:
    """Push of closed mesh i, whose tooth pairs are appended to `pairs` if they are wanted.

    `pairs.advance` and `pairs.pace` tell where the meshes stand.

    Returns:
        Force [N], power lost to damping [W], power that its changing shape puts in [W].
    """
    train, tau = model.train, pairs.tau[model.train.kind[i]]
    side, kind, segment = state.side[i], train.kind[i], state.segment[i]
    d, rate, e_rate = deflection(train, moment, i, x, v, pairs.advance, pairs.pace)
    squeeze, closing = side * d - model.load.offset, side * rate
    cycle = moment.start[i] + side * pairs.advance
    u = cycle - train.edge[kind, segment]
    total, growth = total_weight(train, kind, segment, u)
    begin = pairs.count
    if pairs.wanted:
        append_pairs(train, state, i, cycle, total, v, pairs)
    if train.faults > 0:
        cramp = (u, squeeze, closing, total, growth)
        force, lost, work = press_faulty(model, moment, i, segment, begin, cramp, pairs)
    else:
        k = train.stiffness_base[kind] + train.stiffness_gain[kind] * total
        force = k * (squeeze + tau * closing)
        lost = tau * k * closing * closing
        work = 0.5 * train.stiffness_gain[kind] * growth
        work *= squeeze * squeeze - model.load.inner_squared
        for n in range(begin, pairs.count):
            pairs.load[n] = max(pairs.share[n] * force, 0.0)
    return force, lost, side * (work * pairs.pace - force * e_rate)


@kernel
def push_drift(model: Record, state: Record, moment: Record, i: int, pace: float) -> float:
    """Growth [N/s] of the push of closed mesh i with its cycle, were its bodies to rest in x."""
    train, kind, side = model.train, model.train.kind[i], state.side[i]
    tau, u = moment.tau[kind], moment.start[i] - train.edge[kind, state.segment[i]]
    d, rate, e_rate = deflection(train, moment, i, state.x, state.v, 0.0, pace)
    total, growth = total_weight(train, kind, state.segment[i], u)
    push = side * d - model.load.offset + tau * side * rate
    drift = train.stiffness_gain[kind] * growth * side * pace * push
    if train.lines[kind] > 0:
        k = train.stiffness_base[kind] + train.stiffness_gain[kind] * total
        bend = form_error_bend(train, i, moment.line_angle, pace)
        drift -= k * side * (e_rate + tau * bend)
    return drift


@kernel
def press_faulty(
    model: Record,
    moment: Record,
    i: int,
    segment: int,
    begin: int,
    cramp: tuple[float, float, float, float, float],
    pairs: Record,
) -> tuple[float, float, float]:
    """Force, loss and work per cycle of a mesh, pair by pair, since each may have its faults.

    `cramp` holds the cycles into the segment, squeeze [m], its rate, the sum of the weights and
    its growth per cycle.
    """
    u, squeeze, closing, total, growth = cramp
    train, kind = model.train, model.train.kind[i]
    stiffness = train.stiffness_base[kind] + train.stiffness_gain[kind] * total
    stiffness_growth = -train.stiffness_base[kind] * growth / total
    force = lost = work = 0.0
    for n in range(begin, pairs.count):
        factor, slope, gap = fault_effect(train, moment, i, segment, n - begin, u)
        healthy = stiffness * pairs.share[n]
        healthy_growth = stiffness * pairs.growth[n] + stiffness_growth * pairs.share[n]
        k, dk = healthy * factor, healthy_growth * factor + healthy * slope
        q = squeeze - gap
        if gap > 0.0 and q < 0.0:
            k = dk = 0.0
        load = k * (q + pairs.tau[kind] * closing)
        if gap > 0.0:
            load = max(load, 0.0)
        force += load
        lost += (load - k * q) * closing
        work += 0.5 * dk * (q * q - model.load.inner_squared)
        pairs.load[n] = max(load, 0.0)
    return force, lost, work


@kernel
def stored_energy(model: Record, state: Record, moment: Record, i: int) -> float:
    """Elastic energy [J] of mesh i; `moment` is room for where it stands."""
    side = state.side[i]
    if side == OPEN:
        return 0.0
    train, kind, segment = model.train, model.train.kind[i], state.segment[i]
    place_mesh(train, state, moment, i)
    u = moment.start[i] - train.edge[kind, segment]
    d = deflection(train, moment, i, state.x, state.v, 0.0, 0.0)[0]
    per_weight = (
        train.stiffness_base[kind] / total_weight(train, kind, segment, u)[0]
        + train.stiffness_gain[kind]
    )
    energy = 0.0
    for p in range(train.present[kind, segment]):
        weight = polynomial(train.weight, kind, segment, p, u, train.terms)[0]
        factor, _, gap = fault_effect(train, moment, i, segment, p, u)
        q = side * d - model.load.offset - gap
        if gap == 0.0 or q > 0.0:
            k = per_weight * weight * factor
            energy += 0.5 * k * (q * q - model.load.inner_squared)
    return energy
