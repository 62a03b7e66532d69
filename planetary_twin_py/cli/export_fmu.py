"""`planetary-twin export-fmu`: a scene as a functional mock-up unit for co-simulation."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..run.tolerance import LIVE_TOLERANCE
from ..terminal.arguments import SceneArgument, SetOption
from ..terminal.messages import fail, one_line_errors
from ..terminal.output_files import file_ending_in
from ..terminal.settings import scene_with


def export_fmu(
    scene: SceneArgument,
    out: Annotated[
        Path,
        typer.Option(metavar="FILE.fmu", help="Write this file.", callback=file_ending_in(".fmu")),
    ],
    fmi: Annotated[str, typer.Option(help="Version of FMI: 3.0 or 2.0.")] = "3.0",
    tolerance: Annotated[
        float, typer.Option(help="Relative tolerance, unless the importing tool sets another.")
    ] = LIVE_TOLERANCE,
    set_: SetOption = None,
) -> None:
    """Export SCENE as a functional mock-up unit (FMU) for co-simulation.

    Inputs and outputs follow from drive.input.port and drive.output.port. The FMU runs on Linux,
    on processors of this kind (x86-64 or 64-bit ARM), without Python.

    Example: planetary-twin export-fmu paper --set drive.input.port=torque --out paper.fmu
    """
    from .._core.levels import architecture
    from ..fmu.export import VERSIONS, exported_levels
    from ..fmu.export import export_fmu as export

    if fmi not in VERSIONS:
        fail(f"--fmi = {fmi!r}: must be {' or '.join(VERSIONS)}")
    with one_line_errors():
        export(scene_with(scene, set_), out, version=fmi, tolerance=tolerance)
    size = out.stat().st_size / 1e6
    levels = ", ".join(map(architecture, exported_levels()))
    typer.echo(f"{out}: FMI {fmi}, {size:.1f} MB, {levels}")
