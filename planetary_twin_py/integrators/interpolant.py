"""What lies within the last step: its interpolant, and samples from it."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from .._compile import kernel
from .._records import AXES, Record
from ..dynamics.body_speed import body_speed
from ..dynamics.drag import apply_drag
from ..dynamics.observe import MESH_FORCE, QUANTITIES, observe
from ..dynamics.state import BEARING, CHURNING
from .propagation import propagate


@kernel
def interpolate(model: Record, march: Record, delay: float) -> None:
    """x and v within the last step: its own motion, or quintic and quartic Hermite interpolants."""
    if march.control.collocated:
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
def sample(model: Record, march: Record, delay: float, out: Samples, row: int) -> None:
    """Write what the train shows `delay` seconds after the start of the last step, within it."""
    train, begin = model.train, march.begin
    interpolate(model, march, delay)
    work = march.work.evaluation
    observe(model, begin, march.moment, march.dense_x, march.dense_v, delay, work, out.mesh[row])
    if train.bearings + train.discs > 0:
        for i in range(train.meshes):
            work.now.push[i] = abs(out.mesh[row, MESH_FORCE, i])
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
