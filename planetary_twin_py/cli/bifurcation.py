"""`planetary-twin bifurcation`: what a gearbox settles to, speeding up and slowing down."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ._arguments import SceneArgument, SetOption, ToleranceOption
from ._fail import fail, remark
from ._settings import changed_scene, settings
from ._study import PICTURES, TABLES, axis, check_suffix, progress, put


def bifurcation(
    scene: SceneArgument,
    out: Annotated[Path, typer.Option(help="Table (.parquet, .csv) or picture (.png, .svg, .pdf)")],
    input_speed: Annotated[
        str, typer.Option(metavar="FROM:TO:COUNT", help="Speeds that are held.")
    ] = "1000rpm:10000rpm:181",
    settling: Annotated[
        float, typer.Option(help="Seconds at each speed before it is looked at.")
    ] = 0.2,
    cycles: Annotated[int, typer.Option(help="Mesh cycles that are looked at.")] = 60,
    phase: Annotated[float, typer.Option(help="Place in the mesh cycle, 0 to 1.")] = 0.0,
    tolerance: ToleranceOption = 1e-4,
    set_: SetOption = None,
) -> None:
    """Poincare sections of the DTE of SCENE against speed, each begun with the motion before it.

    The DTE of every mesh is taken once each mesh cycle. One dot: the motion repeats with the
    meshing; two: with every other tooth; a cloud: chaos. Where the two ways differ, two motions
    are possible.

    Example: planetary-twin bifurcation paper --set input_torque=10 --set backlash=20um
    --input-speed 8000rpm:10000rpm:41 --out jumps.png
    """
    check_suffix(out, TABLES + PICTURES)
    from ..scene.unused import without_effect
    from ..studies.axes import Axis
    from ..studies.bifurcation import Holding
    from ..studies.bifurcation import bifurcation as run

    try:
        changes = settings(set_ or [])
        loaded = changed_scene(scene, changes)
        speeds = axis(loaded, "input_speed", input_speed)
        if not isinstance(speeds, Axis):
            fail(f"--input-speed = {input_speed!r}: must be FROM:TO:COUNT")
        holding = Holding(settling, cycles, phase, tolerance)
        with progress("speeds held", 2 * len(speeds.values)) as advance:

            def hear(failure: str | None) -> None:
                advance(1)
                if failure:
                    remark(failure)

            table = run(loaded, speeds.values, holding, hear)
        put(table, out)
    except (ValueError, OSError) as error:
        fail(error)
    for line in without_effect(loaded, changes):
        remark(f"warning: {line}")
    typer.echo(f"{out}: {len(speeds.values)} speeds up and down")
