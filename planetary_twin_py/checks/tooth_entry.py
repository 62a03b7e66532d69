"""Whether loaded teeth enter contact under about the load for which their entry was computed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..model.stiffness_laws import LIGHTEST_LINE_LOAD
from ..model.teeth import build_tables
from ..scene import Scene
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
    worst, times = 0.0, 1.0
    lightest = LIGHTEST_LINE_LOAD * scene.gearset.face_width
    forces = np.abs(run.mesh["mesh_force_mean"]).reshape(len(SIDES), -1)
    for kind, entry in enumerate(build_tables(scene).entries):
        for force in (forces[kind].min(), forces[kind].max()):
            there = max(float(force), lightest)
            if abs(there / entry.force - 1.0) < NEAR:
                continue
            error = entry.error_of_shares(there)
            if error > worst:
                worst, times = error, there / entry.force
    if worst <= LARGEST_ERROR:
        return None
    return (
        f"mesh.entry = 'loaded': the mean mesh force is {times:.2g} times that of "
        "operating_point.input_torque, for which the entry of teeth was computed: load shares of "
        f"tooth pairs are wrong by up to {worst:.2g}; start with the torque of the run"
    )
