"""`planetary-twin bifurcation`: steady motions against speed, with rising and falling speed."""

from __future__ import annotations

from typing import Annotated

import typer

from ..terminal.arguments import SceneArgument, SetOption, StudyOut, ToleranceOption
from ..terminal.messages import fail, one_line_errors, warn
from ..terminal.settings import changed_scene, settings
from ..terminal.unit_options import SECONDS
from ._study import axis, need_packages, reported, write_results


def bifurcation(
    scene: SceneArgument,
    out: StudyOut,
    input_speed: Annotated[
        str | None,
        typer.Option(
            metavar="FROM:TO:COUNT",
            help="Input speeds, each held constant.",
            show_default="181 in a decade up to drive.speed_limit",
        ),
    ] = None,
    settling: Annotated[
        float,
        typer.Option(help="Simulated time at each speed before sampling starts.", **SECONDS),
    ] = 0.2,
    cycles: Annotated[int, typer.Option(help="Mesh cycles sampled at each speed.")] = 60,
    phase: Annotated[float, typer.Option(help="Phase of the mesh cycle to sample, 0 to 1.")] = 0.0,
    tolerance: ToleranceOption = 1e-4,
    set_: SetOption = None,
) -> None:
    """Poincare sections of the DTE of SCENE against speed, each started from the previous motion.

    The DTE of every mesh is sampled once per mesh cycle. One point at a speed: the motion has the
    period of the mesh cycle; two points: twice that period; a cloud: chaotic motion. Where rising
    and falling speed differ, two motions are possible.

    Example: planetary-twin bifurcation paper --set input_torque=10 --set backlash=20um
    --input-speed 8000rpm:10000rpm:41 --out jumps.png
    """
    need_packages(out)
    from pyarrow import compute as pc

    from ..checks.fixed_axes import held_axes_warning
    from ..scene.unused import without_effect
    from ..studies.axes import Axis, default_speeds
    from ..studies.bifurcation import Dwell
    from ..studies.bifurcation import bifurcation as run
    from ..studies.doubts import inaccuracies

    with one_line_errors():
        changes = settings(set_ or [])
        loaded = changed_scene(scene, changes)
        input_speed = input_speed or default_speeds(loaded, 0.1, "181")
        speeds = axis(loaded, "input_speed", input_speed)
        if not isinstance(speeds, Axis):
            fail(f"--input-speed = {input_speed!r}: must be FROM:TO:COUNT")
        dwell = Dwell(settling, cycles, phase, tolerance)
        with reported("speeds held", 2 * len(speeds.values)) as report:
            table = run(loaded, speeds.values, dwell, report)
        write_results(table, out)
    runs = table.filter(pc.equal(table["cycle"], 0))
    warn((held_axes_warning(loaded), *without_effect(loaded, changes), *inaccuracies(runs)))
    typer.echo(f"{out}: {len(speeds.values)} speeds, rising and falling")
