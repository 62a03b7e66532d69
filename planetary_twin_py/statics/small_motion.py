"""Stiffness of bearings for small motion about the static equilibrium."""

from __future__ import annotations

import numpy as np

from ..model.planar_rows import CENTRAL
from ..model.rolling_bearings import eccentricity, press, rolling_bearing
from ..scene import Scene
from ..scene.supports import Support
from .load_sharing import load_sharing

LEAST_LOAD = 1e-3  # [N] below which a static force is what rounding leaves


def radial_stiffness(scene: Scene, kind: str) -> tuple[float, float]:
    """Stiffness of the bearing of a kind of body for small motion.

    A rolling bearing, or one with clearance, is linear about its mean load in static equilibrium
    under the torque of the scene. It is stiffer along the load than across it, where it resists by
    the turn of its force. The load of a planet acts across its radius. That of the others turns
    with what causes it, so both of their values are the mean. Without load such a bearing has no
    stiffness.

    Args:
        scene: scene with supports.
        kind: "sun", "planet", "ring" or "carrier".

    Returns:
        Stiffness along the radius of a planet, or along x, and across it [N/m].

    Raises:
        ValueError: see `load_sharing`.
    """
    support: Support = getattr(scene.supports, kind)
    if not depends_on_load(support):
        stiffness = support.bearing or 0.0
        return stiffness, stiffness
    load = _mean_load(scene, kind)
    if load < LEAST_LOAD:
        return 0.0, 0.0
    along, size = _pressed(support, load)
    across = load / size
    if kind == "planet":
        return across, along
    mean = 0.5 * (along + across)
    return mean, mean


def depends_on_load(support: Support) -> bool:
    """Whether the stiffness of a bearing depends on its load.

    Args:
        support: the bearing.
    """
    return support.rolling is not None or (bool(support.bearing) and support.clearance > 0.0)


def _pressed(support: Support, load: float) -> tuple[float, float]:
    """Stiffness along a load [N/m], and the displacement that it causes [m]."""
    if support.rolling is None:
        stiffness = support.bearing or 0.0
        return stiffness, support.clearance + load / stiffness
    law = rolling_bearing(support.rolling)
    size = eccentricity(law, support.clearance, load)
    return float(press(law, support.clearance, np.array([size]))[2, 0]), size


def _mean_load(scene: Scene, kind: str) -> float:
    if scene.operating_point.input_torque == 0.0:
        return 0.0
    found = load_sharing(scene)
    force = found.planet_bearing if kind == "planet" else found.bearing[:, [CENTRAL.index(kind)]]
    return float(np.linalg.norm(force, axis=2).mean())
