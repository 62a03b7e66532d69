"""Stiffness of bearings for small motion about the static equilibrium."""

from __future__ import annotations

import numpy as np

from ..dynamics.rolling_bearings import eccentricity, press, rolling_bearing
from ..scene import Scene
from ..scene.supports import Support
from .load_sharing import load_sharing
from .rows import CENTRAL

LEAST_LOAD = 1e-3  # [N] below which a static force is what rounding leaves


def radial_stiffness(scene: Scene, kind: str) -> tuple[float, float]:
    """Stiffness of the bearing of a kind of body for small motion.

    A rolling bearing is linear about its mean load in static equilibrium under the torque of the
    scene. It is stiffer along the load than across it. The load of a planet acts across its radius.
    That of the others turns with what causes it, so both of their values are the mean. Without load
    a rolling bearing has no stiffness.

    Args:
        scene: scene with supports.
        kind: "sun", "planet", "ring" or "carrier".

    Returns:
        Stiffness along the radius of a planet, or along x, and across it [N/m].

    Raises:
        ValueError: see `load_sharing`.
    """
    support: Support = getattr(scene.supports, kind)
    if support.rolling is None:
        stiffness = support.bearing or 0.0
        return stiffness, stiffness
    load = _mean_load(scene, kind)
    if load < LEAST_LOAD:
        return 0.0, 0.0
    law = rolling_bearing(support.rolling)
    size = eccentricity(law, support.clearance, load)
    along = float(press(law, support.clearance, np.array([size]))[2, 0])
    across = load / size
    if kind == "planet":
        return across, along
    mean = 0.5 * (along + across)
    return mean, mean


def _mean_load(scene: Scene, kind: str) -> float:
    if scene.operating_point.input_torque == 0.0:
        return 0.0
    found = load_sharing(scene)
    force = found.planet_bearing if kind == "planet" else found.bearing[:, [CENTRAL.index(kind)]]
    return float(np.linalg.norm(force, axis=2).mean())
