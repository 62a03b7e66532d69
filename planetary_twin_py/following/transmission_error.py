"""Transmission error over mesh cycles: from counts of two encoders, and from the model.

TE = r (A theta_i - B theta_o), with A and B the turns of the sun per turn of input and output and r
the base radius of the sun. Position and error are computed in integers: a ratio rounded at the
fifth digit would let the error drift by tens of micrometres per minute.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..scene import Scene
from ..scene.other_dynamics import under
from ..simulation.simulate import simulate
from .train import FollowedTrain, followed_train

Array = NDArray[np.float64]
Counts = NDArray[np.int64]

MORE = 2.0  # mesh cycles beyond those that are used, because vibration changes the angles


class ErrorSamples(NamedTuple):
    """Transmission error at successive samples."""

    cycle: Counts
    """Whole mesh cycles of the sun's angle, (n,)."""
    part: Array
    """Remaining fraction of a mesh cycle, from 0 to 1, (n,)."""
    error: Array
    """Transmission error [m], (n,), relative to the zeros of the encoders."""


class ErrorOfCounts:
    """Converts counts to transmission error."""

    def __init__(self, train: FollowedTrain, counts_per_turn: tuple[int, int]) -> None:
        first, second = counts_per_turn
        position = train.cycles / first
        self._position = position.numerator, position.denominator
        a, b = train.twist[0] / first, train.twist[1] / second
        self._common = math.lcm(a.denominator, b.denominator)
        self._factors = int(a * self._common), int(b * self._common)
        self._size = 2.0 * math.pi * train.lever / self._common

    def __call__(self, counts: Counts, zero: tuple[int, int]) -> ErrorSamples:
        """Convert counts of input and output, (n, 2); the error is zero at the counts `zero`."""
        numerator, denominator = self._position
        position = counts[:, 0] * numerator
        cycle = position // denominator
        part = np.asarray((position - cycle * denominator) / denominator)
        a, b = self._factors
        anchor = int(counts[0, 0]), int(counts[0, 1])
        base = (anchor[0] - zero[0]) * a - (anchor[1] - zero[1]) * b  # exact at any age
        steps = (counts[:, 0] - anchor[0]) * a - (counts[:, 1] - anchor[1]) * b
        return ErrorSamples(cycle, part, np.asarray(self._size * (float(base) + steps)))


def model_error(
    scene: Scene, cycles: int, points: int, settling: float, tolerance: float
) -> tuple[int, Array]:
    """Transmission error of a scene in steady running, at equal steps of the sun's angle.

    Args:
        scene: scene at its operating point; torsional dynamics replace quasi-static running.
        cycles: number of mesh cycles.
        points: samples in a mesh cycle.
        settling: time before the mesh cycles [s].
        tolerance: relative tolerance of the integrator.

    Returns:
        Number of the first step of 1/points mesh cycles since the start, and the transmission error
        from there on [m], (cycles * points,). Steps decrease if the sun turns backwards.
    """
    train = followed_train(scene)
    dynamics = "torsional" if scene.quasi_static else scene.dynamics
    scene = scene.replace(**under(scene, dynamics))
    rate = abs(float(train.cycles) * scene.operating_point.input_speed) / (2.0 * math.pi)
    run = simulate(
        scene, (cycles + MORE) / rate, points * rate, tolerance=tolerance, settling=settling
    )
    input_, output = (run.angle[:, run.bodies.index(member)] for member in train.members)
    a, b = (float(turns) for turns in train.twist)
    position = abs(float(train.cycles)) * np.abs(input_) / (2.0 * math.pi)
    first = math.ceil(float(position[0]) * points)
    steps = (first + np.arange(cycles * points)) / points
    error = np.interp(steps, position, train.lever * (a * input_ - b * output))
    forwards = float(train.cycles) * float(input_[-1]) > 0.0
    return (first, error) if forwards else (-(first + cycles * points - 1), error[::-1])
