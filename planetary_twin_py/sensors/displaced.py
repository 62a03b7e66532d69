"""Displacement of a body in the housing."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..model.planar_rows import CENTRAL
from .path import carrier_angle
from .sensed import Sensed

Array = NDArray[np.float64]


def displacement_along(sensed: Sensed, body: str, axis: float) -> Array:
    """Displacement of a body in a direction of the housing.

    Args:
        sensed: samples with displacements, which are in the frame that turns with the carrier.
        body: "sun", "ring" or "carrier".
        axis: the direction, counter-clockwise [rad].

    Returns:
        Displacements [m], (samples,).
    """
    if sensed.displacement is None:
        raise ValueError(f"displacement of the {body}: requires dynamics with moving axes")
    x, y = np.ascontiguousarray(sensed.displacement[:, CENTRAL.index(body)].T)
    turned = axis - carrier_angle(sensed)
    return np.asarray(x * np.cos(turned) + y * np.sin(turned))
