"""Deflection of the teeth, and the deflection up to which their elasticity is linear."""

from __future__ import annotations

from ..model.mean_stiffness import mean_stiffness
from ..model.teeth import build_teeth
from ..run.result import Result
from ..scene import Scene
from ..units.catalogue import SIDES, side_title
from ..units.engineering import figure
from .mesh_loads import mesh_loads

LARGEST = 0.1
"""Largest deflection of a mesh, in modules. A tooth is about 2.25 modules high, so two teeth that
yield by 0.1 module each turn by about 1/45, and their flanks meet far off the nominal line of
action. The tips of loaded steel teeth yield by about 0.01 module."""


def deflection_warning(scene: Scene, run: Result | None = None) -> str | None:
    """Warn if the force of the meshes over their mean stiffness is beyond linear elasticity.

    So the motion within the backlash is left out.

    Args:
        scene: the scene; teeth that are impossible are reported by its run.
        run: its result, whose mean forces count; None: the static forces count.

    Returns:
        A sentence, or None.
    """
    try:
        stiffness = mean_stiffness(build_teeth(scene)).tolist()
    except ValueError:
        return None
    forces = mesh_loads(scene, run)
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
