"""Load sharing, with a warning where vibration leaves the static equilibrium."""

from __future__ import annotations

import warnings
from collections.abc import Iterator

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


def load_sharing_remarks(scene: Scene, found: LoadSharing) -> Iterator[str]:
    """Sentences on what the static load sharing of a scene leaves out.

    Args:
        scene: the scene.
        found: its load sharing.
    """
    if found.both_flanks:
        yield (
            "both flanks of a mesh touch at some positions: the backlash is used up, "
            "and planets are wedged between sun and ring"
        )
    if any(fault.kind != "pin" for fault in scene.faults):
        yield "faults: are left out, teeth are healthy here"
    if scene.tilting_axes:
        yield (
            f"dynamics = {scene.dynamics}: these statics are planar, without the axial "
            "motion and tilting of axes (supports.*.axial, tilting), which change shares and "
            "bearing forces; simulate with dynamics = quasi_static_spatial"
        )
    if scene.mesh.backlash == "regulatory_factor":
        yield "mesh.backlash = regulatory_factor: forces grow from no deflection"
