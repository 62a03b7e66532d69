"""Integrals and extremes of what the meshes show, over the last step.

A step by collocation is read at its nodes, as its energy ledger is; where its meshes vibrate too
fast for them, transmission errors and forces are read at even times, by Simpson's rule. A step by
Rosenbrock's method is read at its ends, by trapezoids.
"""

from __future__ import annotations

import math

import numpy as np

from .._combine import combine, combine_both
from .._compile import kernel, law
from .._overwrite import copy_array
from .._records import FLAG, MESHES, REAL, WHOLE, Record, layout
from ..dynamics.equations import forces, squeeze
from ..dynamics.mesh_force import mesh_motion, move_meshes
from ..dynamics.mesh_sums import MESH_SUMS, SQUARE, SUMS
from ..dynamics.observe import DTE, MESH_FORCE
from .contact_sums import (
    CONTACT_SUMS,
    add_films,
    add_friction,
    clear_contacts,
    find_contacts,
    put_contacts,
)
from .propagation import modes_at, propagate
from .radau import MOST

POINTS = 129  # room
FEWEST = 4  # intervals between even times
NEAR = 0.02  # of a step, by which it may end beside its last node

# Transmission errors and forces at instants of the step.
LOOK = layout(
    count=WHOLE,
    at=(REAL, (POINTS,)),  # [s] since its start
    weight=(REAL, (POINTS,)),  # of a quadrature [s]
    d=(REAL, (POINTS, MESHES)),  # [m]
    push=(REAL, (POINTS, MESHES)),  # [N]
)

STEP_SUMS = layout(
    step=MESH_SUMS,  # over the last step
    part=MESH_SUMS,  # over a part of it
    total=MESH_SUMS,  # since it was taken, up to the start of the last step
    taken=REAL,  # of the last step [s]
    look=LOOK,
    contacts=CONTACT_SUMS,
    weight=(REAL, (MOST,)),  # of the nodes of a step by collocation [s]
    stale=FLAG,  # `rates` are not those of the start of the step
    rates=(REAL, (SUMS, MESHES)),  # by which the integrals grow at the end of a stiff step
    push=(REAL, (MESHES,)),  # there [N]
)


@kernel
def sum_step(model: Record, march: Record) -> None:
    """Sum up the step just made, before contacts change at its end."""
    sums, train = march.sums, model.train
    sums.step.time = march.control.step
    if march.control.collocated:
        _add_collocated(model, march)
    else:
        _add_ends(model, march)
    add_look(train, march.moment, sums.look, sums.step)


@law
def _weight(march: Record, n: int) -> float:
    """Weight of node n in the integral over the step [s]."""
    nodes, u = march.run.nodes, march.run.motion.step
    t, weight = march.control.step / march.run.motion.step, 0.0
    for k in range(nodes.count):
        u *= t
        weight += nodes.coefficient[k, n] * u / (k + 1)
    return weight


@kernel
def _add_collocated(model: Record, march: Record) -> None:
    """Fill the look at a step by collocation, and sum up its contacts and friction."""
    train, run, sums, h = model.train, march.run, march.sums, march.control.step
    clear_contacts(train, sums.contacts)
    for n in range(run.nodes.count):
        sums.weight[n] = _weight(march, n)
        add_friction(train, run.evaluation[n], sums.weight[n], sums.contacts)
    intervals = even_intervals(march, train.lanes, train.meshes, h)
    if abs(h - run.motion.step) > NEAR * run.motion.step:
        _look_at_even_times(model, march, max(intervals, FEWEST))
        _add_films_of_look(model, march)
    else:
        if intervals == 0:
            _look_at_nodes(train, march)
        else:
            _look_at_even_times(model, march, intervals)
        _add_films(model, march)
    put_contacts(train, model.oil, sums.contacts, sums.step.integral)


@kernel
def _add_films(model: Record, march: Record) -> None:
    """Films at the nodes; at two of them without friction, as nothing else asks for them."""
    run, contacts, h = march.run, march.sums.contacts, march.control.step
    if model.train.friction:
        for n in range(run.nodes.count):
            add_films(model.train, run.evaluation[n].pairs, march.sums.weight[n], contacts)
        return
    early, late = max(run.nodes.count - 4, 0), run.nodes.count - 2
    t, u = run.nodes.abscissa[early] * run.motion.step, run.nodes.abscissa[late] * run.motion.step
    weight = h * (u - 0.5 * h) / (u - t)  # of the early one, exact for straight lines
    for n in (early, late):
        work = run.evaluation[n]
        find_contacts(model, march.moment, run.node_v[n], work)
        add_films(model.train, work.pairs, weight if n == early else h - weight, contacts)


@kernel
def _add_films_of_look(model: Record, march: Record) -> None:
    """Films at the times of the look.

    Beyond the end of a step whose flanks part, nodes show films of no load.
    """
    train, sums, work, dense = model.train, march.sums, march.work.evaluation, march.dense
    for k in range(sums.look.count):
        propagate(model, march, sums.look.at[k], dense.x, dense.v)
        move_meshes(train, dense.x, dense.v, work.now)
        squeeze(model, march.begin, march.moment, dense.x, dense.v, sums.look.at[k], work)
        find_contacts(model, march.moment, dense.v, work)
        add_films(train, work.pairs, sums.look.weight[k], sums.contacts)


@kernel
def even_intervals(march: Record, lanes: int, meshes: int, h: float) -> int:
    """Even intervals that resolve h seconds of a step by collocation, 0: as many nodes do.

    Nodes resolve as many radians of a free wave as they are; even times one each. Waves below the
    tolerance do not count.
    """
    run = march.run
    reach, fastest = run.known.reach[run.motion.modes], 0.0
    for m in range(lanes):
        phase = run.motion.rate[m] * h
        if phase > max(fastest, float(run.nodes.count)):
            swing = abs(run.motion.free[0, m])
            swing += abs(run.motion.free[1, m]) / run.motion.rate[m]
            largest = 0.0
            for i in range(meshes):
                largest = max(largest, reach[m, i])
            swings = run.motion.slow[m] == run.motion.fast[m]
            if swings and swing * largest > march.control.tolerance_x:
                fastest = phase
    return min(2 * math.ceil(0.5 * fastest), POINTS - 1)


@kernel
def set_even_times(look: Record, begin: float, end: float, intervals: int) -> None:
    """Set times from `begin` to `end` [s] and weights of Simpson's rule; intervals are even."""
    gap = (end - begin) / intervals
    look.count = intervals + 1
    for k in range(look.count):
        look.at[k], look.weight[k] = begin + k * gap, gap / 3.0 * (4.0 if k % 2 == 1 else 2.0)
    look.weight[0] = look.weight[intervals] = gap / 3.0


@kernel
def _look_at_nodes(train: Record, march: Record) -> None:
    """Fill the look at the start and the nodes of a step by collocation."""
    run, look = march.run, march.sums.look
    look.count, look.at[0], look.weight[0] = run.nodes.count + 1, 0.0, 0.0
    combine(run.known.motion[run.motion.modes], run.q, train.bodies, look.d[0])
    copy_array(look.push[0], march.first.now.push)
    for n in range(run.nodes.count):
        look.at[n + 1] = run.nodes.abscissa[n] * run.motion.step
        look.weight[n + 1] = march.sums.weight[n]
        copy_array(look.d[n + 1], run.node_d[n])
        copy_array(look.push[n + 1], run.evaluation[n].now.push)


@kernel
def _look_at_even_times(model: Record, march: Record, intervals: int) -> None:
    """Fill the look at `intervals` + 1 even times of a step by collocation."""
    train, begin, run = model.train, march.begin, march.run
    look, work, dense = march.sums.look, march.work.evaluation, march.dense
    form, motion = run.known.form[run.motion.modes], run.known.motion[run.motion.modes]
    set_even_times(look, 0.0, march.control.step, intervals)
    for k in range(look.count):
        modes_at(run, train.lanes, look.at[k])
        combine_both(form, run.now_q, run.now_p, train.bodies, dense.x, dense.v)
        combine_both(motion, run.now_q, run.now_p, train.bodies, look.d[k], work.now.rate)
        copy_array(work.now.d, look.d[k])
        squeeze(model, begin, march.moment, dense.x, dense.v, look.at[k], work)
        copy_array(look.push[k], work.now.push)


@kernel
def _add_ends(model: Record, march: Record) -> None:
    """Fill the look at the ends of a stiff step, and sum up its contacts and friction."""
    train, begin, moment, sums = model.train, march.begin, march.moment, march.sums
    look, out, half = sums.look, sums.step.integral, 0.5 * march.control.step
    look.count, look.at[0], look.at[1] = 2, 0.0, 2.0 * half
    look.weight[0] = look.weight[1] = half
    copy_array(look.push[0], sums.push)
    if sums.stale:
        work = march.work.evaluation
        forces(model, begin, moment, begin.x, begin.v, 0.0, begin.trim, work)
        copy_array(look.push[0], work.now.push)
        _put_rates(model, moment, begin.v, work, sums)
    for row in range(SUMS):
        for i in range(train.lanes):
            out[row, i] = half * sums.rates[row, i]
    copy_array(look.push[1], march.last.now.push)
    copy_array(sums.push, march.last.now.push)
    _put_rates(model, moment, march.end.v, march.last, sums)
    for row in range(SUMS):
        for i in range(train.lanes):
            out[row, i] += half * sums.rates[row, i]
    for i in range(train.meshes):
        look.d[0, i] = mesh_motion(train, i, begin.x)
        look.d[1, i] = mesh_motion(train, i, march.end.x)


@kernel
def _put_rates(model: Record, moment: Record, v: np.ndarray, work: Record, sums: Record) -> None:
    """Let `sums.rates` hold what an EVALUATION shows of contacts and friction."""
    if not model.train.friction:
        find_contacts(model, moment, v, work)
    clear_contacts(model.train, sums.contacts)
    add_films(model.train, work.pairs, 1.0, sums.contacts)
    add_friction(model.train, work, 1.0, sums.contacts)
    put_contacts(model.train, model.oil, sums.contacts, sums.rates)


@kernel
def add_look(train: Record, moment: Record, look: Record, step: Record) -> None:
    """Integrals and extremes of transmission errors and forces, from the look."""
    out, lanes = step.integral, train.lanes
    for i in range(lanes):
        out[DTE, i] = out[SQUARE, i] = out[MESH_FORCE, i] = 0.0
        step.dte_peak[i] = step.force_peak[i] = 0.0
    for n in range(look.count):
        weight = look.weight[n]
        for i in range(lanes):
            d, force = look.d[n, i], max(look.push[n, i], 0.0)
            out[DTE, i] += weight * d
            out[SQUARE, i] += weight * d * d
            out[MESH_FORCE, i] += weight * moment.side[i] * force
            step.dte_peak[i] = max(step.dte_peak[i], abs(d))
            step.force_peak[i] = max(step.force_peak[i], force)
    for n in range(1, look.count - 1):
        left, right = look.at[n - 1] - look.at[n], look.at[n + 1] - look.at[n]
        lean, bend = 1.0 / left, 1.0 / (right - left)
        rise = 1.0 / right
        for i in range(lanes):
            at = (left, right, lean, rise, bend)
            d = _vertex(at, look.d[n - 1, i], look.d[n, i], look.d[n + 1, i])
            push = _vertex(at, look.push[n - 1, i], look.push[n, i], look.push[n + 1, i])
            step.dte_peak[i] = max(step.dte_peak[i], abs(d))
            step.force_peak[i] = max(step.force_peak[i], push)


@law
def _vertex(
    at: tuple[float, float, float, float, float], before: float, here: float, after: float
) -> float:
    """Vertex of the parabola through three values, if it lies between them; else the middle one.

    `at` holds the times of the outer values after the middle one, their inverses, and that of
    their distance.
    """
    left, right, lean, rise, bend = at
    a, b = (before - here) * lean, (after - here) * rise
    curve = (b - a) * bend
    slope = a - curve * left
    place = -0.5 * slope / curve
    return here + 0.5 * slope * place if left < place < right else here
