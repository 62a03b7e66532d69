"""What lies within the last step: its interpolant, samples from it, contacts that change on it."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from .._compile import kernel
from .._records import AXES, Record
from ..dynamics.body_speed import body_speed
from ..dynamics.contact_events import departure
from ..dynamics.cycle import cycle_shift
from ..dynamics.drag import apply_drag
from ..dynamics.observe import MESH_FORCE, QUANTITIES, observe
from ..dynamics.state import BEARING, CHURNING

from .collocation import SCANNED, first_scanned, play_at, propagate, scan, suspect_flanks

SLACK = 0.01  # share of the local tolerance by which flanks may pull or pass each other
BISECTIONS = 50  # down to the resolution of a double


@kernel
def interpolate(model: Record, march: Record, delay: float) -> None:
    """x and v within the last step: quintic and quartic Hermite interpolants."""
    if march.control.modal:
        propagate(model, march, delay, march.dense_x, march.dense_v)
        return
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
def departure_at(model: Record, march: Record, i: int, delay: float) -> float:
    """`departure` of mesh i on the interpolant."""
    if march.control.modal and model.train.lines[model.train.kind[i]] == 0:
        return play_at(model, march, i, delay, SLACK * march.control.tolerance_x)
    interpolate(model, march, delay)
    train, moment, x, v = model.train, march.moment, march.dense_x, march.dense_v
    advance = moment.cycle_rate * delay + cycle_shift(train, x) - cycle_shift(train, march.begin.x)
    pace = moment.cycle_rate + cycle_shift(train, v)
    slack = SLACK * march.control.tolerance_x
    return departure(model, march.begin, moment, i, x, v, (advance, pace, slack))


@kernel
def at_event(model: Record, march: Record, i: int) -> bool:
    """Whether the step ends where the contact of mesh i changes, to within its slack."""
    play = departure_at(model, march, i, march.control.step)
    return abs(play) <= SLACK * march.control.tolerance_x


@kernel
def first_flank_event(model: Record, march: Record) -> tuple[int, float]:
    """Mesh whose contact changes first within the step, and when; (-1, step) if none does."""
    first, when, scanned = -1, march.control.step, 0.0
    if march.control.modal and not suspect_flanks(model, march):
        return first, when
    for i in range(model.train.meshes):
        low, high = 0.0, when
        if march.control.modal and model.train.lines[model.train.kind[i]] == 0:
            if march.run.suspect[i] == 0:
                continue
            if scanned != when:
                scanned = when
                scan(model, march, when)
            place = first_scanned(model, march, i, SLACK * march.control.tolerance_x)
            if place == SCANNED:
                continue
            low, high = place * when / SCANNED, (place + 1) * when / SCANNED
        elif departure_at(model, march, i, when) >= 0.0:
            continue
        first, when = i, _close_in(model, march, i, low, high)
    return first, when


@kernel
def _close_in(model: Record, march: Record, i: int, low: float, high: float) -> float:
    """Where the play of mesh i falls below zero: regula falsi, Illinois form (Dahlquist and
    Björck 1974, Numerical Methods, section 6.3)."""
    above, below = departure_at(model, march, i, low), departure_at(model, march, i, high)
    enough, last = 0.1 * SLACK * march.control.tolerance_x, 0
    for _ in range(BISECTIONS):
        if -below <= enough or high - low <= 1e-16 * high:
            break
        share = above / (above - below) if above > 0.0 else 0.5
        middle = low + min(max(share, 1e-3), 1.0 - 1e-3) * (high - low)
        value = departure_at(model, march, i, middle)
        if value >= 0.0:
            low, above = middle, value
            if last > 0:
                below *= 0.5
            last = 1
        else:
            high, below = middle, value
            if last < 0:
                above *= 0.5
            last = -1
    return high


class Samples(NamedTuple):
    """Samples of one window. Body j stands at turns @ ratio[j] turns + angle[j]."""

    mesh: np.ndarray  # (room, QUANTITIES, meshes), see `observe`
    turns: np.ndarray  # (room, AXES) whole turns of the motors
    angle: np.ndarray  # (room, bodies) [rad]
    speed: np.ndarray  # (room, bodies) [rad/s]
    drag: np.ndarray  # (room, 2) power that bearings and churning take [W]


def new_samples(train: Record, room: int) -> Samples:
    """Room for `room` samples."""
    bodies, meshes = int(train.bodies), int(train.meshes)
    return Samples(
        np.zeros((room, QUANTITIES, meshes)),
        np.zeros((room, AXES)),
        np.zeros((room, bodies)),
        np.zeros((room, bodies)),
        np.zeros((room, 2)),
    )


@kernel
def sample(model: Record, march: Record, time: float, out: Samples, row: int) -> None:
    """Write what the train shows at `time`, which lies within the last step."""
    train, begin = model.train, march.begin
    delay = time - begin.time
    interpolate(model, march, delay)
    pairs = march.work.evaluation.pairs
    observe(model, begin, march.moment, march.dense_x, march.dense_v, delay, pairs, out.mesh[row])
    if train.bearings + train.discs > 0:
        work = march.work.evaluation
        for i in range(train.meshes):
            work.push[i] = abs(out.mesh[row, MESH_FORCE, i])
        work.power[:] = 0.0
        apply_drag(model, begin, march.dense_v, work)
        out.drag[row, 0], out.drag[row, 1] = work.power[BEARING], work.power[CHURNING]
    out.turns[row] = begin.turns
    for j in range(train.bodies):
        out.angle[row, j] = march.dense_x[j] / train.radius[j]
        out.speed[row, j] = body_speed(train, begin, march.dense_v, j)
        for a in range(train.axes):
            frame = 2.0 * math.pi * begin.fraction[a] + begin.speed[a] * delay
            out.angle[row, j] += train.ratio[j, a] * frame
