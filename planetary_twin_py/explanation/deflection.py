"""Deflection of the teeth, and the deflection up to which their elasticity is linear."""

from __future__ import annotations

from ..model.mean_stiffness import mean_stiffness
from ..model.teeth import build_teeth
from ..run.result import Result
from ..scene import Scene
from ..units.catalogue import SIDES, side_title
from ..units.engineering import figure
from .mesh_loads import loads_of_run, loads_of_scene

LARGEST = 0.1
"""Largest deflection of a mesh, in modules. A tooth is about 2.25 modules high, so two teeth that
yield by 0.1 module each turn by about 1/45, and their flanks meet far off the nominal line of
action. The tips of loaded steel teeth yield by about 0.01 module."""


def deflection_of_run(scene: Scene, run: Result) -> str | None:
    """Warn if the mean force of any mesh in a run bends teeth beyond linear elasticity.

    Args:
        scene: the scene.
        run: its result.

    Returns:
        A sentence, or None.
    """
    return _warning(scene, loads_of_run(run))


def deflection_of_scene(scene: Scene) -> str | None:
    """Warn if the static force of the meshes bends teeth beyond linear elasticity.

    Args:
        scene: the scene; teeth that are impossible are reported by its run.

    Returns:
        A sentence, or None.
    """
    try:
        return _warning(scene, loads_of_scene(scene))
    except ValueError:
        return None


def _warning(scene: Scene, forces: list[float]) -> str | None:
    """Warn of force over mean stiffness, which leaves out the motion within the backlash."""
    stiffness = mean_stiffness(build_teeth(scene)).tolist()
    deflections = [force / k if k else 0.0 for force, k in zip(forces, stiffness, strict=True)]
    largest, module = max(deflections), scene.gearset.transverse.module
    if not largest > LARGEST * module:
        return None
    side = side_title(SIDES[deflections.index(largest)])
    elasticity = (
        "lubrication.youngs_modulus" if scene.mesh.stiffness == "involute" else "the stiffnesses"
    )
    return (
        f"deflection of the teeth = {figure(largest, 'm')} in the {side} meshes, "
        f"{largest / module:.2g} modules: their elasticity is linear up to {LARGEST:g} modules at "
        "most, beyond which teeth bend out of their places, so forces, losses and efficiency are "
        f"wrong; check {elasticity} (mesh.stiffness = {scene.mesh.stiffness}), or "
        "reduce the torque"
    )
