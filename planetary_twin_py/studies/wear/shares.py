"""Load shares of the planets without vibration, with the errors and the wear of a scene."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...checks.fixed_axes import equal_planets
from ...run.twin import Twin
from ...scene import Scene
from ..stribeck import STILL

Array = NDArray[np.float64]


def planet_shares(scene: Scene, frequency: float) -> Array:
    """Mean force of each mesh over a turn of the ring against the carrier, over that of all.

    Args:
        scene: the scene.
        frequency: of the mesh [Hz].

    Returns:
        Shares of the sun-planet and of the planet-ring meshes, (2, planets).
    """
    if equal_planets(scene):
        return np.ones((2, scene.gearset.planets))
    dynamics = scene.dynamics if scene.quasi_static else STILL.get(scene.dynamics, "quasi_static")
    twin = Twin(scene.replace(dynamics=dynamics))
    force = np.abs(
        twin.advance(scene.gearset.tooth_numbers.ring / frequency).mesh["mesh_force_mean"]
    ).reshape(2, -1)
    return np.asarray(force / force.mean(axis=1, keepdims=True))
