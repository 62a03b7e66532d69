"""Whether the meshes of each planet carry load in static equilibrium."""

from __future__ import annotations

import warnings
from functools import lru_cache

from ..scene import Scene
from ..text.warning_types import AccuracyWarning
from .load_sharing import load_sharing

SCENES_KEPT = 16


@lru_cache(maxsize=SCENES_KEPT)
def carrying(scene: Scene) -> tuple[float, ...]:
    """Part of the time in which the meshes of each planet carry load, on either flank.

    Errors of position, runout and weight can part the flanks of a planet from those of sun and
    ring. Without load there is no equilibrium to judge by, and all planets count as in contact.

    Args:
        scene: scene with the torque; without `supports`, all axes are held.

    Returns:
        Shares of the positions of `load_sharing`, 0 to 1, (planets,).
    """
    every = (1.0,) * scene.gearset.planets
    if scene.operating_point.input_torque == 0.0 or not _parts(scene):
        return every
    try:
        found = load_sharing(scene)
    except ValueError as reason:
        warnings.warn(
            f"all planets count as loaded, because their static loads are not found: {reason}",
            AccuracyWarning,
            stacklevel=2,
        )
        return every
    touching = (found.mesh_force[:, :, : scene.gearset.planets] > 0.0).any(axis=1)
    return tuple(touching.mean(axis=0).tolist())


def _parts(scene: Scene) -> bool:
    """Whether anything displaces flanks that are nominally in contact."""
    mesh, errors = scene.mesh, scene.pins
    runout = mesh.runout.sun or mesh.runout.planet or mesh.runout.ring
    planets = errors.pin_radial or errors.pin_tangential or errors.planet_thickness
    teeth = mesh.sun_planet_error.amplitudes or mesh.planet_ring_error.amplitudes
    heavy = scene.supports is not None and scene.supports.gravity > 0.0
    return bool(runout or planets or teeth or errors.of_axes or heavy)
