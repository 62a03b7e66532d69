"""`planetary-twin stribeck`: friction of the meshes against the lambda ratio."""

from __future__ import annotations

from typing import Annotated

import typer

from ..terminal.arguments import SceneArgument, SetOption, StudyOut, values_option
from ..terminal.messages import one_line_errors, remark
from ..terminal.settings import scene_with
from ._study import axis, need_packages, reported, warn_of, write_results


def stribeck(
    scene: SceneArgument,
    out: StudyOut,
    input_speed: Annotated[
        str | None, values_option("Input speeds", "41 in four decades up to drive.speed_limit")
    ] = None,
    set_: SetOption = None,
) -> None:
    """Stribeck curves of the sun and ring meshes of SCENE: boundary, viscous and total friction.

    Each speed is one quasi-static mesh cycle under the load of the scene. Axes move if they do in
    the dynamics of the scene. The lambda ratio is computed, even if the scene prescribes one.

    Example: planetary-twin stribeck paper --set lubrication.boundary=load_sharing --out curve.png
    """
    need_packages(out)
    from ..simulation.threads import Threads
    from ..studies.axes import Axis, default_speeds
    from ..studies.stribeck import stribeck as run
    from ..studies.stribeck import stribeck_scene

    with one_line_errors():
        loaded = scene_with(scene, set_)
        speeds = axis(loaded, "input_speed", input_speed or default_speeds(loaded, 1e-4, "41:log"))
        count = len(speeds.values) if isinstance(speeds, Axis) else 0
        with reported("speeds", count) as report:
            table = run(loaded, speeds, Threads(), report)
        write_results(table, out, kind="stribeck")
    computed = stribeck_scene(loaded)
    warn_of(table, [computed])
    oil = loaded.lubrication
    if oil.boundary == "greenwood_tripp" and not oil.includes_boundary_friction:
        remark(
            "warning: lubrication.boundary = greenwood_tripp: asperities carry only a few per cent "
            "of the load, so friction hardly rises for thin films; use load_sharing for a "
            "boundary regime"
        )
    typer.echo(f"{out}: {count} speeds, dynamics = {computed.dynamics}")
