"""A scene with the wear of its flanks."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ...scene import Scene
from ...scene.worn import WornFlanks, WornMesh
from .flanks import Depths, Flanks

DIGITS = 9  # of depths and positions


def worn_scene(scene: Scene, flanks: Sequence[Flanks], depths: Sequence[Depths]) -> Scene:
    """A scene whose teeth have depths of wear.

    Args:
        scene: the scene.
        flanks: of sun-planet and planet-ring meshes.
        depths: their wear.
    """
    sun, ring = (_mesh(f, d) for f, d in zip(flanks, depths, strict=True))
    worn = WornFlanks(sun_planet=sun, planet_ring=ring)
    # What was valid before is so with any wear in the range of its section.
    return scene.model_copy(update={"mesh": scene.mesh.model_copy(update={"worn": worn})})


def _mesh(flanks: Flanks, depths: Depths) -> WornMesh:
    first, second, planets = (_rounded(values) for values in depths)
    return WornMesh(
        position=_rounded(flanks.position),
        first=first,
        second=second,
        planets=planets if any(planets) else (),
    )


def _rounded(values: NDArray[np.float64]) -> tuple[float, ...]:
    return tuple(float(f"{value:.{DIGITS}g}") for value in values)
