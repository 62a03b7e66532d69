"""Forces of the meshes that the warnings of pressure and deflection judge."""

from __future__ import annotations

from ..model.layout import Layout
from ..run.result import Result
from ..scene import Scene
from ..units.catalogue import SIDES


def mesh_loads(scene: Scene, run: Result | None) -> list[float]:
    """Magnitude of the force of the sun-planet and planet-ring meshes [N].

    Args:
        scene: the scene.
        run: its result, whose largest mean force of each kind counts; None: the static force.
    """
    if run is None:
        return [abs(Layout(scene).mesh_force(scene.operating_point.input_torque))] * len(SIDES)
    loads = abs(run.mesh["mesh_force_mean"]).reshape(len(SIDES), -1).max(axis=1)
    return [float(load) for load in loads]
