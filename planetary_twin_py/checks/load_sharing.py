"""Load sharing, with a warning where vibration leaves the static equilibrium."""

from __future__ import annotations

import warnings

import numpy as np

from ..modal.whirl import whirl_warning
from ..model.gearbox import Gearbox
from ..scene import Scene
from ..statics.load_sharing import LoadSharing
from ..statics.load_sharing import load_sharing as static_load_sharing
from ..text.warning_types import AccuracyWarning


def load_sharing(scene: Scene, turns: np.ndarray | None = None) -> LoadSharing:
    """Static load sharing among the planets, see `statics.load_sharing`.

    Args:
        scene: as there.
        turns: as there, (P,).

    Returns:
        Forces and displacements at each position; with an `AccuracyWarning` if the speeds of the
        scene let a whirl of the axes grow.

    Raises:
        ValueError: as there.
    """
    found = static_load_sharing(scene, turns)
    if warning := whirl_warning(Gearbox(scene), scene.operating_point):
        warnings.warn(warning, AccuracyWarning, stacklevel=2)
    return found
