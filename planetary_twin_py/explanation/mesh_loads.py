"""Forces of the meshes that the warnings of pressure and deflection judge."""

from __future__ import annotations

from ..model.layout import Layout
from ..run.result import Result
from ..scene import Scene
from ..units.catalogue import SIDES


def loads_of_run(run: Result) -> list[float]:
    """Largest magnitude of the mean forces of the sun-planet and planet-ring meshes [N].

    Args:
        run: result of a run.
    """
    loads = abs(run.mesh["mesh_force_mean"]).reshape(len(SIDES), -1).max(axis=1)
    return [float(load) for load in loads]


def loads_of_scene(scene: Scene) -> list[float]:
    """Magnitude of the static force of the sun-planet and planet-ring meshes [N].

    Args:
        scene: the scene.
    """
    return [abs(Layout(scene).mesh_force(scene.operating_point.input_torque))] * len(SIDES)
