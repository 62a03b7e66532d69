"""Acceleration of a rigid ring on its bearing, from its displacement and its rotation.

A filter differentiates twice: the positions have no aliases to speak of, as what is above half of
their rate is small in a position.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..model.layout import Layout
from ..scene.sensors.accelerometer import Accelerometer
from ..scene.sensors.paths import RigidRing
from .displaced import displacement_along
from .filters import DERIVATIVE, SECOND_DERIVATIVE
from .path import SensorInput, body_index
from .sensed import Sensed

Array = NDArray[np.float64]


def rigid_path(layout: Layout, sensor: Accelerometer, path: RigidRing) -> SensorInput:
    """What an accelerometer on a rigid ring senses.

    Args:
        layout: the gearbox, with moving axes.
        sensor: the sensor.
        path: its path.

    Returns:
        Displacement of the ring along the axis of the sensor, and speed of its rotation.
    """
    across = sensor.direction == "tangential"
    axis = sensor.angle + (0.5 * math.pi if across else 0.0)
    radius = path.radius if across and path.radius else 0.0
    ring = body_index("ring")

    def signals(sensed: Sensed) -> list[Array]:
        moved = displacement_along(sensed, "ring", axis)
        return [moved, radius * sensed.speed[:, ring]] if across else [moved]

    responses = (SECOND_DERIVATIVE, DERIVATIVE) if across else (SECOND_DERIVATIVE,)
    return SensorInput(signals, responses)
