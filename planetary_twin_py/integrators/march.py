"""Drive a one-step method from event to event and sample what lies between.

Events are tooth pairs entering or leaving, flanks meeting or parting, and the speed set-point
reaching its target. Steps end on them, so the equations are smooth within every step. The window
a caller asks for never clips a step: samples come from the step's interpolant, and the state at
the end of the window is that of the last step begun. So the path does not depend on the windows.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from .._compile import kernel
from .._records import BODIES, FLAG, REAL, WHOLE, Record, layout
from ..dynamics.contact_events import (
    change_contact, change_segment, departure, mesh_cycle, nearest_to_segment,
)
from ..dynamics.equations import (
    EVALUATION, MOMENT, cycle_shift, damping_time, forces, mesh_motion,
)
from ..dynamics.observe import QUANTITIES, observe
from ..dynamics.state import OPEN, STATE
from ..dynamics.tooth_friction import copy_friction
from .rosenbrock import ORDER, WORKSPACE, step

SHORTEST_STEP = 1e-13  # [s] below it two events count as one
EDGE = 1e-9  # [-] mesh cycles within which a tooth pair counts as having entered or left
SLACK = 0.01  # share of the local tolerance by which flanks may pull or pass each other
SAFETY, SHRINK, GROW = 0.8, 0.25, 2.0

# Step control and counters.
CONTROL = layout(
    tolerance_x=REAL,  # local error a step may make in a transmission error [m]
    tolerance_v=REAL,  # and in the speed of a body [m/s]
    next_step=REAL,  # [s]
    step=REAL,  # the last one taken [s]
    longest=REAL,  # [s]
    changed=FLAG,  # contacts or loads are no longer those of the last evaluation
    steps=WHOLE,
    rejected=WHOLE,
    evaluations=WHOLE,
    pair_events=WHOLE,
    flank_events=WHOLE,
)

# A run in progress: the step from `begin` to `end`, and what interpolates it.
MARCH = layout(
    begin=STATE,
    end=STATE,
    moment=MOMENT,
    first=EVALUATION,  # forces at `begin`
    last=EVALUATION,  # forces at `end`, with the contacts of `begin`
    dense_x=(REAL, (BODIES,)),  # interpolated
    dense_v=(REAL, (BODIES,)),
    control=CONTROL,
    work=WORKSPACE,
)


@kernel
def copy_state(source: Record, target: Record) -> None:
    """Overwrite `target`."""
    target.x[:] = source.x
    target.v[:] = source.v
    target.side[:] = source.side
    target.segment[:] = source.segment
    target.time = source.time
    target.turns = source.turns
    target.fraction = source.fraction
    target.speed = source.speed
    target.trim = source.trim
    target.set_speed = source.set_speed
    target.energy[:] = source.energy


@kernel
def _rebase(train: Record, state: Record) -> None:
    """Let the frame catch up with the motor: its x and v become zero."""
    motor = train.coupling[0, 0]
    angle, rate = state.x[motor] / train.radius[motor], state.v[motor] / train.radius[motor]
    for j in range(train.bodies):
        state.x[j] -= train.ratio[j] * train.radius[j] * angle
        state.v[j] -= train.ratio[j] * train.radius[j] * rate
    state.x[motor] = 0.0
    state.v[motor] = 0.0
    state.speed += rate
    fraction = state.fraction + angle / (2.0 * math.pi)
    state.turns += math.floor(fraction)
    state.fraction = fraction - math.floor(fraction)


@kernel
def _set_moment(model: Record, state: Record, moment: Record) -> None:
    train = model.train
    moment.cycle_rate = train.cycles * state.speed / (2.0 * math.pi)
    gap = model.load.target_speed - state.set_speed
    moment.slew = math.copysign(model.load.slew_rate, gap) if gap != 0.0 else 0.0
    for i in range(train.meshes):
        if state.side[i] != OPEN:
            cycle = mesh_cycle(train, state, i, state.side[i])
            moment.start[i] = nearest_to_segment(train, train.kind[i], state.segment[i], cycle)


@kernel
def _time_to_event(model: Record, march: Record) -> float:
    """Time [s] to the next tooth pair event or change of the set-point's slope."""
    train, state, moment = model.train, march.begin, march.moment
    pace = moment.cycle_rate + cycle_shift(train, state.v)
    nearest = math.inf
    for i in range(train.meshes):
        if state.side[i] == OPEN:
            continue
        rate = state.side[i] * pace
        kind, segment = train.kind[i], state.segment[i]
        if rate > 0.0:
            nearest = min(nearest, (train.edge[kind, segment + 1] - moment.start[i]) / rate)
        elif rate < 0.0:
            nearest = min(nearest, (train.edge[kind, segment] - moment.start[i]) / rate)
    if moment.slew != 0.0:
        gap = model.load.target_speed - state.set_speed
        nearest = min(nearest, gap / moment.slew)
    return max(nearest, SHORTEST_STEP)


@kernel
def _error_norm(model: Record, march: Record) -> float:
    """Largest local error of a mesh or of the speed of a body, relative to its tolerance."""
    work, control = march.work, march.control
    largest = 0.0
    for i in range(model.train.meshes):
        tau = march.moment.tau[model.train.kind[i]]
        error = abs(mesh_motion(model.train, i, work.error_x))
        # Damping turns an error of the rate into one of the force, k tau times as large.
        error = max(error, tau * abs(mesh_motion(model.train, i, work.error_v)))
        largest = max(largest, error / control.tolerance_x)
    for j in range(model.train.bodies):
        largest = max(largest, abs(work.error_v[j]) / control.tolerance_v)
    return largest


@kernel
def _try(model: Record, march: Record, h: float) -> None:
    """One step of h from `begin` into `end`, without regard to events."""
    begin, end = march.begin, march.end
    copy_state(begin, end)
    step(model, begin, march.moment, h, march.first, end, march.work)
    end.time = begin.time + h
    end.set_speed = begin.set_speed + march.moment.slew * h
    turn = begin.fraction + begin.speed * h / (2.0 * math.pi)
    end.turns = begin.turns + math.floor(turn)
    end.fraction = turn - math.floor(turn)
    end.energy[:] = begin.energy + march.work.energy
    march.control.step = h
    forces(model, begin, march.moment, end.x, end.v, h, end.trim, march.last)
    march.control.evaluations += 4


@kernel
def interpolate(model: Record, march: Record, delay: float) -> None:
    """x and v within the last step: quintic and quartic Hermite interpolants."""
    h = march.control.step
    t = delay / h
    u = t * t * t
    # Quintic basis on position, velocity and acceleration at both ends, and its derivative.
    p1 = u * (10.0 + t * (-15.0 + 6.0 * t))
    v0, v1 = t - u * (6.0 + t * (-8.0 + 3.0 * t)), u * (-4.0 + t * (7.0 - 3.0 * t))
    a0 = 0.5 * (t * t - u * (3.0 + t * (-3.0 + t)))
    a1 = 0.5 * u * (1.0 + t * (-2.0 + t))
    s = t * t
    dp1 = s * (30.0 + t * (-60.0 + 30.0 * t))
    dv0, dv1 = 1.0 - s * (18.0 + t * (-32.0 + 15.0 * t)), s * (-12.0 + t * (28.0 - 15.0 * t))
    da0 = 0.5 * (2.0 * t - s * (9.0 + t * (-12.0 + 5.0 * t)))
    da1 = 0.5 * s * (3.0 + t * (-8.0 + 5.0 * t))
    b, e = march.begin, march.end
    for j in range(model.train.bodies):
        f0 = march.first.force[j] / model.train.mass[j] * h * h
        f1 = march.last.force[j] / model.train.mass[j] * h * h
        gap = e.x[j] - b.x[j]
        march.dense_x[j] = b.x[j] + gap * p1 + h * (v0 * b.v[j] + v1 * e.v[j]) + a0 * f0 + a1 * f1
        slope = gap * dp1 + h * (dv0 * b.v[j] + dv1 * e.v[j]) + da0 * f0 + da1 * f1
        march.dense_v[j] = slope / h


@kernel
def _departure_at(model: Record, march: Record, i: int, delay: float) -> float:
    """`departure` of mesh i on the interpolant."""
    interpolate(model, march, delay)
    train = model.train
    d, rate = mesh_motion(train, i, march.dense_x), mesh_motion(train, i, march.dense_v)
    slack = SLACK * march.control.tolerance_x
    return departure(model, march.begin, i, march.moment.tau[train.kind[i]], d, rate, slack)


@kernel
def _first_flank_event(model: Record, march: Record) -> tuple[int, float]:
    """Mesh whose contact changes first within the step, and when; (-1, step) if none does."""
    h = march.control.step
    first, when = -1, h
    for i in range(model.train.meshes):
        if _departure_at(model, march, i, when) >= 0.0:
            continue
        low, high = 0.0, when
        for _ in range(50):
            middle = 0.5 * (low + high)
            if _departure_at(model, march, i, middle) >= 0.0:
                low = middle
            else:
                high = middle
        first, when = i, high
    return first, when


@kernel
def _pass_edges(model: Record, march: Record) -> None:
    """Change the segment of every mesh that has come to the edge of its own."""
    train, end = model.train, march.end
    pace = march.moment.cycle_rate + cycle_shift(train, end.v)
    for i in range(train.meshes):
        side = end.side[i]
        if side == OPEN:
            continue
        kind = train.kind[i]
        for _ in range(train.segments[kind]):
            cycle = mesh_cycle(train, end, i, side)
            segment = end.segment[i]
            cycle = nearest_to_segment(train, kind, segment, cycle)
            if side * pace > 0.0 and cycle >= train.edge[kind, segment + 1] - EDGE:
                change_segment(model, end, i, 1)
            elif side * pace < 0.0 and cycle <= train.edge[kind, segment] + EDGE:
                change_segment(model, end, i, -1)
            else:
                break
            march.control.pair_events += 1
            march.control.changed = True


@kernel
def _accept(model: Record, march: Record, mesh: int) -> None:
    """Let the step stand; `mesh` changes its contact at its end (-1: none)."""
    if mesh >= 0:
        change_contact(model, march.end, mesh)
        march.control.flank_events += 1
        march.control.changed = True
    _pass_edges(model, march)
    gap = model.load.target_speed - march.end.set_speed
    if gap * march.moment.slew <= 0.0 or abs(gap) < 1e-12 * model.load.slew_rate:
        march.end.set_speed = model.load.target_speed
        march.control.changed |= march.moment.slew != 0.0
    march.control.steps += 1


@kernel
def begin_step(model: Record, march: Record) -> None:
    """Start a new step where the last one ended."""
    begin, moment = march.begin, march.moment
    copy_state(march.end, begin)
    _rebase(model.train, begin)
    _set_moment(model, begin, moment)
    if march.control.changed:
        for kind in range(2):
            moment.tau[kind] = damping_time(model.train, kind, begin.speed)
        forces(model, begin, moment, begin.x, begin.v, 0.0, begin.trim, march.first)
        march.control.evaluations += 1
        march.control.changed = False
    else:  # forces do not depend on the frame in which x is measured
        march.first.force[:] = march.last.force
        march.first.power[:] = march.last.power
        copy_friction(march.last.pairs, march.first.pairs)


@kernel
def one_step(model: Record, march: Record, longest: float) -> None:
    """One accepted step of at most `longest` seconds from `begin`, ending on the first event."""
    control = march.control
    event = _time_to_event(model, march)
    h = min(min(control.next_step, control.longest), longest)
    if event < 2.0 * h:  # two equal steps rather than a long and a tiny one
        h = event if event <= h else 0.5 * event
    h = min(h, longest)
    while True:
        _try(model, march, h)
        error = _error_norm(model, march)
        factor = SAFETY * error ** (-1.0 / ORDER) if error > 0.0 else GROW
        if error <= 1.0 or h <= SHORTEST_STEP:
            break
        march.control.rejected += 1
        h = max(h * max(SHRINK, factor), SHORTEST_STEP)
    mesh, when = _first_flank_event(model, march)
    if mesh >= 0 and when < h:
        _try(model, march, max(when, SHORTEST_STEP))
    candidate = h * min(GROW, max(SHRINK, factor))
    # A step cut short by an event says little about the steps to come.
    control.next_step = max(candidate, control.next_step) if factor >= 1.0 else candidate
    _accept(model, march, mesh)


class Samples(NamedTuple):
    """Samples of one window. The body j of a sample stands at turns * ratio[j] turns + angle[j]."""

    mesh: np.ndarray  # (room, QUANTITIES, meshes), see `observe`
    turns: np.ndarray  # (room,) whole turns of the motor
    angle: np.ndarray  # (room, bodies) [rad]
    speed: np.ndarray  # (room, bodies) [rad/s]


def new_samples(train: Record, room: int) -> Samples:
    """Room for `room` samples."""
    bodies, meshes = int(train.bodies), int(train.meshes)
    return Samples(
        np.zeros((room, QUANTITIES, meshes)),
        np.zeros(room),
        np.zeros((room, bodies)),
        np.zeros((room, bodies)),
    )


@kernel
def sample(model: Record, march: Record, time: float, out: Samples, row: int) -> None:
    """Write what the train shows at `time`, which lies within the last step."""
    train, begin = model.train, march.begin
    delay = time - begin.time
    interpolate(model, march, delay)
    pairs = march.work.evaluation.pairs
    observe(
        model, begin, march.moment, march.dense_x, march.dense_v, delay, pairs, out.mesh[row]
    )
    speed = begin.speed
    frame = 2.0 * math.pi * begin.fraction + speed * delay
    out.turns[row] = begin.turns
    for j in range(train.bodies):
        out.angle[row, j] = train.ratio[j] * frame + march.dense_x[j] / train.radius[j]
        out.speed[row, j] = train.ratio[j] * speed + march.dense_v[j] / train.radius[j]


@kernel
def advance(
    model: Record, march: Record, until: float, first_sample: int, sample_rate: float, out: Samples
) -> int:
    """Integrate to `until` [s]; sample k is taken at k/sample_rate seconds on the way.

    Returns:
        How many samples were taken, beginning with number `first_sample`.
    """
    taken = 0
    while True:
        end = min(until, march.end.time)
        while taken < out.turns.size and (first_sample + taken) / sample_rate <= end:
            sample(model, march, (first_sample + taken) / sample_rate, out, taken)
            taken += 1
        if march.end.time >= until:
            return taken
        begin_step(model, march)
        one_step(model, march, math.inf)


@kernel
def cut(model: Record, march: Record, time: float) -> None:
    """Take back what lies beyond `time` [s], which is within the last step.

    What changes from outside, changes there: the next step begins at `time`.
    """
    if time < march.end.time:
        length = time - march.begin.time
        if length > SHORTEST_STEP:
            one_step(model, march, length)
        else:
            copy_state(march.begin, march.end)
    march.end.time = time
    march.control.changed = True
