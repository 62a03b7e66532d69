"""Readings, innovations and balances of the torques of gearboxes of one type, in arrays."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

PARAMETERS = (
    "friction_level", "torque_zero", "drag", "torque_gain", "inertia", "friction_over_torque",
    "friction_over_speed",
)  # fmt: skip
F, B, D, G, J, F_T, F_W = range(len(PARAMETERS))


class Measured(NamedTuple):
    """Means of one time for the filter, (n,) each; NaN where a quantity was not measured."""

    time: float
    """Middle of the mean [s]."""
    input_torque: Array
    """[N m]."""
    output_torque: Array
    """[N m]."""
    counts: Array
    """Numbers of readings in the means of both torques, (2, n) or (2, 1)."""
    speed: Array
    """Speed of the input [rad/s]."""
    acceleration: Array
    """Acceleration of the input [rad/s^2]."""
    acceleration_noise: Array
    """Standard deviation of the acceleration [rad/s^2]."""
    oil_temperature: Array
    """[K]."""


def joined(reads: Sequence[Measured]) -> Measured:
    """Readings of one gearbox at many times, (1,) each, as arrays over the times."""
    _, *fields = zip(*reads, strict=True)
    return Measured(reads[-1].time, *(np.concatenate(parts, axis=-1) for parts in fields))


class Innovation(NamedTuple):
    """Measured minus expected sum of both torques, referred to the input."""

    value: float
    """[N m]."""
    sd: float
    """Its expected standard deviation [N m]."""
    gated: bool
    """Whether the gate rejects it."""


class InnovationArrays(NamedTuple):
    """Measured minus expected sums of both torques, referred to the input, (n,) each."""

    value: Array
    """[N m]; NaN where a torque or the speed was not measured, or the train was at rest."""
    sd: Array
    """Expected standard deviations [N m]."""
    gated: Mask
    """Whether the gate rejects them."""


FRICTION, DRAGGING, ZERO, GAIN = (
    "friction", "drag", "zero of a torque sensor", "gain of a torque sensor",
)  # fmt: skip
CAUSES = FRICTION, DRAGGING, ZERO, GAIN  # of a step of the balance


class Balances(NamedTuple):
    """Measured minus expected sums of both torques, without the uncertainty of the parameters."""

    value: Array
    """[N m], (n,); NaN where there is no balance."""
    sd: Array
    """Standard deviation of the readings in it [N m], (n,)."""
    slope: Array
    """Derivatives of the expected sum over the parameters, (n, 7)."""
    friction: Array
    """Part of tooth friction in the expected sum [N m], (n,)."""
    torque: Array
    """Mean of the torques of both ends, weighted by the inverse variances [N m], (n,)."""
    torque_sd: Array
    """Its standard deviation [N m], (n,)."""
    loss: Array
    """Loss torque of the scene [N m], (n,)."""

    @property
    def added(self) -> Array:
        """What each of `CAUSES` adds to the balance [N m], (n, 4): all friction of the teeth, a
        drag of 1 N m, a zero of 1 N m, and a gain of 100 %."""
        return np.column_stack([self.friction, self.slope[:, [D, B, G]]])

    def since(self, first: int) -> Balances:
        """The balances from an index on."""
        return Balances(*(values[first:] for values in self))
