"""Whether tilted flanks touch over the whole face width, as the model assumes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.mean_stiffness import mean_stiffness
from ..model.planar_rows import COAST, DRIVE
from ..model.teeth import build_teeth
from ..model.tilting_rows import row_of_scene
from ..scene import Scene

if TYPE_CHECKING:
    from ..run.result import Result


def uneven_deflection(scene: Scene, run: Result) -> float:
    """Relative difference of the approach of the flanks at an end of the face.

    Args:
        scene: scene with axes that tilt.
        run: result of the scene.

    Returns:
        Mean slope times half of the face width over the mean approach, of the worst mesh. Above 1,
        flanks separate at an end of the face. 0 if axes do not tilt or meshes are not loaded.
    """
    statistics = None if run.axes is None else run.axes.statistics
    if statistics is None or statistics.tilting is None:
        return 0.0
    tilt, planets = statistics.tilting.tilt_mean, scene.gearset.planets
    stiffness = mean_stiffness(build_teeth(scene))
    worst = 0.0
    for mesh, force in enumerate(run.mesh["mesh_force_mean"]):
        if force == 0.0:
            continue
        kind, planet = divmod(mesh, planets)
        side = DRIVE if force > 0.0 else COAST
        row = row_of_scene(scene, side, ("sun", "ring")[kind], planet)
        slope = row.slope[0] @ tilt[kind] + row.slope[1] @ tilt[3 + planet]
        at_end = 0.5 * scene.gearset.face_width * abs(float(slope))
        mesh_stiffness = float(stiffness[kind]) * scene.errors.of_planet(planet).stiffness
        worst = max(worst, at_end * mesh_stiffness / abs(float(force)))
    return worst


def face_warning(scene: Scene, run: Result) -> str | None:
    """Warn if flanks separate at an end of the face.

    Args:
        scene: scene of the run.
        run: result of the run.

    Returns:
        A sentence, or None.
    """
    uneven = uneven_deflection(scene, run)
    if uneven <= 1.0:
        return None
    return (
        f"gears tilt so far that the flanks of a mesh separate at an end of the face ({uneven:.2g} "
        "times the mean approach), which is not modelled: tilts and moments are less accurate; "
        "increase the tilting stiffness of the bearings (supports.*.tilting)"
    )
