"""Whether loaded teeth enter contact under about the load for which their entry was computed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.stiffness_laws import LIGHTEST_LINE_LOAD
from ..model.teeth import entry_of
from ..scene import Scene

if TYPE_CHECKING:
    from ..run.result import Result

LARGEST_ERROR = 0.1  # of the load share of a pair, at about 0.8 and 1.25 times the load


def entry_warning(scene: Scene, run: Result) -> str | None:
    """Warn if a run is under another load than that of `mesh.entry: loaded`.

    Args:
        scene: scene of the run.
        run: result of the run.

    Returns:
        A sentence, or None.
    """
    if scene.mesh.entry != "loaded":
        return None
    planets, worst, times = scene.gearset.planets, 0.0, 1.0
    lightest = LIGHTEST_LINE_LOAD * scene.gearset.face_width
    for kind in (0, 1):
        entry = entry_of(scene, kind)
        forces = run.mesh["mesh_force_mean"][kind * planets : (kind + 1) * planets]
        for force in {max(abs(float(each)), lightest) for each in forces}:
            error = entry.error_of_shares(force)
            if error > worst:
                worst, times = error, force / entry.force
    if worst <= LARGEST_ERROR:
        return None
    return (
        f"mesh.entry = 'loaded': the mean mesh force is {times:.2g} times that of "
        "operating_point.input_torque, for which the entry of teeth was computed: load shares of "
        f"tooth pairs are wrong by up to {worst:.2g}; start with the torque of the run"
    )
