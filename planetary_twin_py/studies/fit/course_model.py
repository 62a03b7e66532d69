"""Input torque of a scene in a measured manoeuvre.

Output torque and speed are given. The input torque follows from the static balance, with the losses
of quasi-static runs at every torque and speed, and from the inertia:

    T_in = -i T_out + s L(T_in, w, oil) + J a,   s = sign(w)

The model omits vibration, which averages out over a bin of a manoeuvre.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from ...following.loss_map import LossMap
from ...following.train import followed_train
from ...scene import Scene
from .course import Array, Course

INERTIAS = "drive.input.inertia", "drive.output.inertia"  # on which steady losses do not depend
PASSES = 2  # of the fixed point: the loss changes by some percent of a change of the torque


@dataclass
class CourseModel:
    """Input torques of a course for values of the free parameters; results are cached.

    `report` is called with the number of points evaluated so far.
    """

    scene: Scene
    free: tuple[str, ...]
    report: Callable[[int], None] = lambda count: None
    _cache: dict[tuple[float, ...], tuple[LossMap, float, float]] = field(default_factory=dict)
    _losses: dict[tuple[float, ...], LossMap] = field(default_factory=dict)

    @property
    def count(self) -> int:
        """Number of evaluated points so far."""
        return len(self._cache)

    def at(self, values: Array, course: Course) -> Array | None:
        """Input torque [N m], (n,), for values in SI, (p,); None if it cannot be simulated."""
        try:
            losses, inertia, ratio = self._loss_data(values)
            return _input_torque(course, losses, inertia, ratio)
        except (ValueError, ArithmeticError):
            return None

    def _loss_data(self, values: Array) -> tuple[LossMap, float, float]:
        key = tuple(values.tolist())
        if key not in self._cache:
            changes: Mapping[str, float] = dict(zip(self.free, key, strict=True))
            scene = self.scene.replace(**changes)
            train = followed_train(scene)
            loss_values = tuple(value for name, value in changes.items() if name not in INERTIAS)
            # The points of a new map are computed when they are needed.
            losses = self._losses.setdefault(loss_values, LossMap(scene))
            self._cache[key] = losses, train.inertia, train.ratio
            self.report(self.count)
        return self._cache[key]

    def residuals(
        self, course: Course, weight: float
    ) -> Callable[[Sequence[Array]], list[Array | None]]:
        """Function that returns weighted differences of simulated and measured torque."""

        def residuals(points: Sequence[Array]) -> list[Array | None]:
            torques = [self.at(point, course) for point in points]
            return [
                None if torque is None else weight * (torque - course.input_torque)
                for torque in torques
            ]

        return residuals


def _input_torque(course: Course, losses: LossMap, inertia: float, ratio: float) -> Array:
    lossless = -ratio * course.output_torque
    sign = np.sign(course.speed)
    torque = lossless
    for _ in range(PASSES):
        torque = lossless + sign * losses(torque, course.speed, course.oil_temperature).total
    return np.asarray(torque + inertia * course.acceleration)
