"""What a path to a sensor is: signals, each with the response behind it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..model.layout import Layout
from .filters import Response
from .sensed import Sensed

Array = NDArray[np.float64]


@dataclass(frozen=True)
class SensorInput:
    """What arrives at a sensor: the sum of some signals, each behind its response."""

    signals: Callable[[Sensed], list[Array]]
    """The signals in consecutive samples, (samples,) each."""
    responses: tuple[Response, ...]
    """Response behind each signal."""


def carrier_angle(sensed: Sensed) -> Array:
    """Angle of the carrier [rad], (samples,)."""
    return np.ascontiguousarray(sensed.angle[:, body_index("carrier")])


def body_index(body: str) -> int:
    """Place of sun, ring or carrier in arrays over the reported bodies."""
    return {"sun": 0, "ring": -2, "carrier": -1}[body]


def planet_places(layout: Layout, sensed: Sensed) -> Array:
    """Angles of the planets in the housing [rad], (samples, planets)."""
    angles = np.asarray(layout.scene.gearset.planet_angles)
    return np.asarray(carrier_angle(sensed)[:, None] + angles)


def ring_force(layout: Layout, sensed: Sensed) -> Array:
    """Forces of the ring meshes, negative on coast flanks [N], (samples, planets)."""
    return np.ascontiguousarray(sensed.mesh_force[:, layout.scene.gearset.planets :])
