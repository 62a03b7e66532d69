"""Distinguishes friction, drag and the zero of a torque sensor after a step of the loss.

The parameters estimated before the step are kept. The innovations after it are compared with three
hypotheses: a change of friction is proportional to the loss of the teeth, a change of drag has the
sign of the rotation, a change of a zero is constant. They differ once load or direction has varied.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

FRICTION, DRAG, ZERO = "friction", "drag", "zero of a torque sensor"
LONGEST = 300.0  # [s] after the step in which innovations are collected
FEWEST = 20  # bins before a cause is excluded
BETTER = 6.0  # units of log-likelihood by which one cause must be better than the others


@dataclass
class Attribution:
    """Collects innovations after a step.

    Args:
        begin: time at which the step was found [s].
    """

    begin: float
    _count: int = 0
    _products: np.ndarray = field(default_factory=lambda: np.zeros((3, 2)))  # c c, c r
    _square: float = 0.0

    def add(self, time: float, innovation: float, sd: float, loss: float, sign: float) -> None:
        """Add an innovation of the filter that keeps the parameters from before the step.

        Args:
            time: time of the innovation [s].
            innovation: measured minus expected torque balance [N m].
            sd: its standard deviation [N m].
            loss: loss torque of tooth friction [N m].
            sign: sign of the speed.
        """
        if time > self.begin + LONGEST:
            return
        courses = np.array([sign * loss, sign, 1.0]) / sd
        score = innovation / sd
        self._products += np.stack([courses**2, courses * score], axis=1)
        self._square += score**2
        self._count += 1

    @property
    def causes(self) -> tuple[str, ...]:
        """Causes that explain these innovations, the most likely one first."""
        names = (FRICTION, DRAG, ZERO)
        if self._count < FEWEST:
            return names
        own, cross = self._products.T
        with np.errstate(invalid="ignore", divide="ignore"):
            gain = np.where(own > 0.0, 0.5 * cross**2 / own, 0.0)
        order = np.argsort(-gain, kind="stable")
        left = 2.0 * (0.5 * self._square - float(gain.max())) / self._count
        near = gain > gain.max() - BETTER * max(left, 1.0)
        return tuple(names[n] for n in order if near[n])
