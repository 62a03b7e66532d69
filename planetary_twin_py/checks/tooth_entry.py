"""Whether loaded teeth enter contact under about the load for which their entry was computed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..model.layout import Layout
from ..model.stiffness_laws import LIGHTEST_LINE_LOAD
from ..model.teeth import build_tables
from ..scene import OperatingPoint, Scene
from ..units.catalogue import SIDES

if TYPE_CHECKING:
    from ..run.result import Result

NEAR = 0.1  # part of the load: up to it, errors of shares are about half of the largest
LARGEST_ERROR = 0.1  # of the load share of a pair, at about 0.8 and 1.25 times the load


def entry_warning(scene: Scene, run: Result) -> str | None:
    """Warn if a run is under another load than that of `mesh.entry: loaded`.

    Args:
        scene: scene of the run.
        run: result of the run.

    Returns:
        A sentence, or None.
    """
    forces = np.abs(run.mesh["mesh_force_mean"]).reshape(len(SIDES), -1)
    return _warning(scene, [(float(each.min()), float(each.max())) for each in forces])


def entry_warning_at(scene: Scene, point: OperatingPoint) -> str | None:
    """Warn if the torque has been changed far from that of `mesh.entry: loaded`.

    Args:
        scene: scene at the start of a run.
        point: its present operating point.

    Returns:
        A sentence, or None.
    """
    force = abs(Layout(scene).mesh_force(point.input_torque))
    return _warning(scene, [(force,)] * len(SIDES))


def _warning(scene: Scene, forces: Sequence[tuple[float, ...]]) -> str | None:
    """Warning at forces of both kinds of mesh [N]."""
    if scene.mesh.entry != "loaded":
        return None
    worst, times = 0.0, 1.0
    lightest = LIGHTEST_LINE_LOAD * scene.gearset.face_width
    for entry, of_kind in zip(build_tables(scene).entries, forces, strict=True):
        for force in (max(each, lightest) for each in of_kind):
            of_table = float(entry.force)
            if abs(force / of_table - 1.0) < NEAR:
                continue
            error = entry.error_of_shares(force)
            if error > worst:
                worst, times = error, force / of_table
    if worst <= LARGEST_ERROR:
        return None
    return (
        f"mesh.entry = 'loaded': the mean mesh force is {times:.2g} times that for which the "
        "entry of teeth was computed, by the input_torque at the start: load shares of tooth "
        f"pairs are wrong by up to {worst:.2g}; start with the torque of the run"
    )
