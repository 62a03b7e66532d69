"""What lies within the last step: its interpolant, and samples from it."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from .._compile import kernel
from .._overwrite import copy_array
from .._records import AXES, Record
from ..dynamics.body_speed import body_speed
from ..dynamics.bristles import place_bristles
from ..dynamics.drag import apply_drag
from ..dynamics.observe import MESH_FORCE, QUANTITIES, observe
from ..dynamics.state import BEARING, CHURNING
from .progress import SHORTEST_STEP
from .propagation import propagate
from .rosenbrock import step


@kernel
def interpolate(model: Record, march: Record, delay: float) -> None:
    """x and v within the last step, as its method would have them had it ended there.

    Polynomials through the ends of a stiff step do not know how flanks settle within it. Its ends
    stand, whatever the load has become since.
    """
    begin, end, dense, h = march.begin, march.end, march.dense, march.control.step
    if march.control.collocated:
        propagate(model, march, delay, dense.x, dense.v)
    elif delay <= SHORTEST_STEP or delay >= h - SHORTEST_STEP:
        nearest = begin if delay <= SHORTEST_STEP else end
        copy_array(dense.x, nearest.x)
        copy_array(dense.v, nearest.v)
        copy_array(dense.bristle, nearest.bristle)
    else:
        step(model, begin, march.moment, delay, march.first, dense, march.work)


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
    place_bristles(work.pairs, march.dense.bristle)
    observe(model, begin, march.moment, march.dense.x, march.dense.v, delay, work, out.mesh[row])
    if train.joints + train.discs > 0:
        for i in range(train.meshes):
            work.now.push[i] = abs(out.mesh[row, MESH_FORCE, i])
        work.power[:] = 0.0
        apply_drag(model, begin, march.dense.v, work)
        out.drag[row, 0], out.drag[row, 1] = work.power[BEARING], work.power[CHURNING]
    copy_array(out.turns[row], begin.turns)
    for j in range(train.bodies):
        out.angle[row, j] = march.dense.x[j] / train.radius[j]
        out.speed[row, j] = body_speed(train, begin, march.dense.v, j)
        for a in range(train.axes):
            frame = 2.0 * math.pi * begin.fraction[a] + begin.speed[a] * delay
            out.angle[row, j] += train.ratio[j, a] * frame
