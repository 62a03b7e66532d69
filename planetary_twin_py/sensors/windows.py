"""Windows: how loud a planet is at an angle from a sensor.

The coefficients W_m of a window over m turns decide which sidebands a sensor receives (McFadden and
Smith 1985, Proc. IMechE C 199, 65-70; Inalpolat and Kahraman 2009, J. Sound Vib. 323, 677-696).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..scene.sensors.paths import WindowShape


def window(path: WindowShape, planets: int, angle: ArrayLike) -> NDArray[np.float64]:
    """Weight of the force of a planet.

    Args:
        path: shape of the window.
        planets: number of planets, for the width of shape: hann.
        angle: from the sensor to the planet [rad], (...).

    Returns:
        Weight, 1 beside the sensor without the constant share `direct`, (...).
    """
    distance = np.mod(np.asarray(angle, dtype=np.float64) + math.pi, math.tau) - math.pi
    if path.shape == "cosine":
        weight = np.cos(0.5 * distance) ** (2 * path.power)
    elif path.shape == "hann":
        lobe = 0.5 + 0.5 * np.cos(planets * distance)
        weight = np.where(np.abs(distance) < math.pi / planets, lobe, 0.0)
    else:
        weight = (0.54 + 0.46 * np.cos(distance)) * np.exp(-path.decay * distance**2)
    return weight + path.direct
