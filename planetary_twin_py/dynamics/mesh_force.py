"""The forces of the meshes, and how their tooth pairs share them.

A closed mesh is squeezed by q = d - e - b on its side, d the transmission error, e the error of
form, b half the backlash. A pair of stiffness k pushes with k (q + tau q'), Salagianni et al. 2017,
(4), (5), (14) along the line of action; a worn pair only when q has passed its missing material.
"""

from __future__ import annotations

import numpy as np

from .._compile import kernel, law
from .._records import MESHES, REAL, Record, layout
from ..mesh.tooth_pairs import PAIRS, TOTAL
from .cycle import cycle_shift, frame_cycle
from .form_errors import form_error, form_error_bend
from .moment import passing_rate, place_mesh
from .state import DAMPING, OPEN, STIFFNESS_WORK

# All meshes at one instant; entry i belongs to mesh i.
MESHES_NOW = layout(
    advance=REAL,  # mesh cycles since the start of the step
    pace=REAL,  # mesh cycles per second
    following=REAL,  # damping time that follows the rate at which teeth pass [s]
    d=(REAL, (MESHES,)),  # transmission error, less the error of form [m]
    rate=(REAL, (MESHES,)),  # of it [m/s]
    error_rate=(REAL, (MESHES,)),  # of the error of form [m/s]
    weight=(REAL, (PAIRS + 1, MESHES)),  # of the tooth pairs, and their sum
    growth=(REAL, (PAIRS + 1, MESHES)),  # per cycle
    inverse=(REAL, (MESHES,)),  # of the sum of the weights
    push=(REAL, (MESHES,)),  # force, 0 if open [N]
    lost=(REAL, (MESHES,)),  # to damping [W]
    work=(REAL, (MESHES,)),  # what the changing shape puts in [W]
)


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
    """d - e [m] of mesh i on the side of `moment`, its rate, and the rate of e [m/s]."""
    d, rate = mesh_motion(train, i, x), mesh_motion(train, i, v)
    if train.lines[train.kind[i]] == 0:
        return d, rate, 0.0
    e, e_rate = form_error(train, i, moment.side[i], moment.line_angle, advance, pace)
    return d - e, rate - e_rate, e_rate


@law
def polynomial(
    table: np.ndarray, kind: int, segment: int, pair: int, u: float, terms: int
) -> tuple[float, float]:
    """A tabulated polynomial and its derivative at `u` cycles into a segment."""
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
def move_meshes(train: Record, x: np.ndarray, v: np.ndarray, now: Record) -> None:
    """Transmission errors and their rates from the motion of the bodies."""
    for i in range(train.meshes):
        now.d[i], now.rate[i] = mesh_motion(train, i, x), mesh_motion(train, i, v)


@kernel
def place_meshes(
    train: Record, state: Record, moment: Record, x: np.ndarray, v: np.ndarray, delay: float,
    now: Record,
) -> None:  # fmt: skip
    """Where the meshes stand `delay` seconds after the start of a step, errors of form counted."""
    now.advance = moment.cycle_rate * delay + cycle_shift(train, x) - cycle_shift(train, state.x)
    now.pace = moment.cycle_rate + cycle_shift(train, v)
    rate = max(passing_rate(train, moment, v), train.lowest_frequency)
    now.following = train.damping_cycles / rate
    if train.lines[0] + train.lines[1] > 0:
        for i in range(train.meshes):
            side = moment.side[i]
            e, e_rate = form_error(train, i, side, moment.line_angle, now.advance, now.pace)
            now.d[i] -= e
            now.rate[i] -= e_rate
            now.error_rate[i] = e_rate


@law
def _weigh(train: Record, moment: Record, now: Record, pair: int) -> None:
    """Weights of one tooth pair of all meshes, and their growth."""
    lanes, advance = train.lanes, now.advance
    if train.terms == 2:  # what a given stiffness needs
        for i in range(lanes):
            u = moment.start[i] - moment.low[i] + moment.side[i] * advance
            slope = moment.weight[pair, 1, i]
            now.weight[pair, i] = moment.weight[pair, 0, i] + slope * u
            now.growth[pair, i] = slope
        return
    last = train.terms - 1
    for i in range(lanes):
        now.weight[pair, i], now.growth[pair, i] = moment.weight[pair, last, i], 0.0
    for t in range(last - 1, -1, -1):
        for i in range(lanes):
            u = moment.start[i] - moment.low[i] + moment.side[i] * advance
            value = now.weight[pair, i]
            now.growth[pair, i] = now.growth[pair, i] * u + value
            now.weight[pair, i] = value * u + moment.weight[pair, t, i]


@kernel
def press(model: Record, moment: Record, now: Record, power: np.ndarray) -> None:
    """Pushes of all meshes from where they stand; what they lose and put in goes into `power`."""
    train, pace, following = model.train, now.pace, now.following
    offset, inner_squared = model.load.offset, model.load.inner_squared
    _weigh(train, moment, now, TOTAL)
    for i in range(train.lanes):
        side, closed = moment.side[i], abs(moment.side[i])
        k = closed * (moment.base[i] + moment.gain[i] * now.weight[TOTAL, i])
        squeeze, closing = side * now.d[i] - offset, side * now.rate[i]
        damped = k * (moment.fixed[i] + following) * closing
        push = k * squeeze + damped
        work = 0.5 * closed * moment.gain[i] * now.growth[TOTAL, i]
        work *= (squeeze * squeeze - inner_squared) * pace
        now.push[i] = push
        now.lost[i] = damped * closing
        now.work[i] = side * (work - push * now.error_rate[i])
    _book(train, now, power)


@law
def _book(train: Record, now: Record, power: np.ndarray) -> None:
    lost = work = 0.0
    for i in range(train.meshes):
        lost += train.copies[i] * now.lost[i]
        work += train.copies[i] * now.work[i]
    power[DAMPING], power[STIFFNESS_WORK] = lost, work


@kernel
def spread(model: Record, moment: Record, now: Record, pairs: Record) -> None:
    """Loads and radii of the tooth pairs of all meshes."""
    train = model.train
    pitch, meshes, lanes = train.base_pitch, train.meshes, train.lanes
    passed = now.advance * pitch
    for i in range(lanes):
        now.inverse[i] = 1.0 / now.weight[TOTAL, i]
    for p in range(train.slots):
        _weigh(train, moment, now, p)
        first = p * meshes  # the next pair takes over what whole registers write beyond
        for i in range(lanes):
            share = now.weight[p, i] * now.inverse[i]
            pairs.share[first + i] = share
            pairs.load[first + i] = max(share * now.push[i], 0.0)
        for i in range(lanes):
            s = moment.side[i] * passed + moment.start[i] * pitch
            pairs.rho1[first + i] = moment.rho1[p, i] + s
            pairs.rho2[first + i] = moment.rho2[p, i] - moment.external[i] * s
            pairs.external[first + i] = moment.external[i]
    pairs.count = train.slots * meshes


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


@kernel
def press_faulty(
    model: Record, state: Record, moment: Record, now: Record, pairs: Record, power: np.ndarray
) -> None:
    """The same as `press` and `spread`, pair by pair, since each may have its faults."""
    train, load = model.train, model.load
    _weigh(train, moment, now, TOTAL)
    spread(model, moment, now, pairs)
    for i in range(train.meshes):
        side, segment = state.side[i], state.segment[i]
        now.push[i] = now.lost[i] = now.work[i] = 0.0
        if side == OPEN:
            continue
        u = moment.start[i] - moment.low[i] + side * now.advance
        squeeze, closing = side * now.d[i] - load.offset, side * now.rate[i]
        tau, total = moment.fixed[i] + now.following, now.weight[TOTAL, i]
        per_weight = moment.base[i] / total + moment.gain[i]
        falling = -moment.base[i] * now.growth[TOTAL, i] / (total * total)
        work = 0.0
        for p in range(train.slots):
            factor, slope, gap = fault_effect(train, moment, i, segment, p, u)
            weight = now.weight[p, i]
            k = per_weight * weight * factor
            dk = (per_weight * now.growth[p, i] + falling * weight) * factor
            dk += per_weight * weight * slope
            q = squeeze - gap
            if gap > 0.0 and q < 0.0:
                k = dk = 0.0
            force = k * (q + tau * closing)
            if gap > 0.0:
                force = max(force, 0.0)
            now.push[i] += force
            now.lost[i] += (force - k * q) * closing
            work += 0.5 * dk * (q * q - load.inner_squared)
            pairs.load[p * train.meshes + i] = max(force, 0.0)
        now.work[i] = side * (work * now.pace - now.push[i] * now.error_rate[i])
    _book(train, now, power)


@kernel
def push_drift(model: Record, state: Record, moment: Record, i: int, pace: float) -> float:
    """Growth [N/s] of the push of closed mesh i with its cycle, were its bodies to rest in x."""
    train, kind, side = model.train, model.train.kind[i], state.side[i]
    tau, u = moment.tau[kind], moment.start[i] - moment.low[i]
    d, rate, e_rate = deflection(train, moment, i, state.x, state.v, 0.0, pace)
    total, growth = total_weight(train, kind, state.segment[i], u)
    push = side * d - model.load.offset + tau * side * rate
    drift = train.stiffness_gain[kind] * growth * side * pace * push
    if train.lines[kind] > 0:
        k = train.stiffness_base[kind] + train.stiffness_gain[kind] * total
        bend = form_error_bend(train, i, moment.side[i], moment.line_angle, pace)
        drift -= k * side * (e_rate + tau * bend)
    return drift


@kernel
def pair_stiffness(
    train: Record, moment: Record, i: int, segment: int, pair: int, u: float
) -> tuple[float, float]:
    """Stiffness [N/m] of a tooth pair `u` cycles into a segment, and missing material [m]."""
    kind = train.kind[i]
    total = total_weight(train, kind, segment, u)[0]
    per_weight = train.stiffness_base[kind] / total + train.stiffness_gain[kind]
    weight = polynomial(train.weight, kind, segment, pair, u, train.terms)[0]
    factor, _, gap = fault_effect(train, moment, i, segment, pair, u)
    return per_weight * weight * factor, gap


@kernel
def stored_energy(model: Record, state: Record, moment: Record, i: int) -> float:
    """Elastic energy [J] of mesh i and its copies; `moment` is room for where it stands."""
    side = state.side[i]
    if side == OPEN:
        return 0.0
    train, kind, segment = model.train, model.train.kind[i], state.segment[i]
    cycles = frame_cycle(train, state, 1) + cycle_shift(train, state.x)
    place_mesh(train, state, moment, i, cycles)
    u = moment.start[i] - moment.low[i]
    d = deflection(train, moment, i, state.x, state.v, 0.0, 0.0)[0]
    energy = 0.0
    for p in range(train.present[kind, segment]):
        k, gap = pair_stiffness(train, moment, i, segment, p, u)
        q = side * d - model.load.offset - gap
        if gap == 0.0 or q > 0.0:
            energy += 0.5 * k * (q * q - model.load.inner_squared)
    return train.copies[i] * energy
