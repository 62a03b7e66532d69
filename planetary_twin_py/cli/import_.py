"""`planetary-twin import`: converts measurements of a test rig to a recording."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..terminal.arguments import SetOption, complete_scene
from ..terminal.console import busy, make_console
from ..terminal.messages import need, one_line_errors
from ..terminal.output_files import check_recording
from ..terminal.settings import scene_with


def import_(
    table: Annotated[
        Path,
        typer.Argument(
            metavar="TABLE", help="CSV, Parquet or MAT file; headings: time [s], power_loss [kW]."
        ),
    ],
    out: Annotated[Path, typer.Option(help="Folder of the new recording, or one file NAME.mcap.")],
    scene: Annotated[
        str,
        typer.Option(
            help="Scene of the gearbox: a packaged scene, or path of a YAML file.",
            autocompletion=complete_scene,
        ),
    ] = "paper",
    set_: SetOption = None,
) -> None:
    """Convert TABLE, the measurements of a test rig, to a recording for `fit` and `view`.

    Each row describes the interval that ends at its time. Columns have the names that `export`
    gives to the fields of gearbox_state and operating_point.

    Example: planetary-twin import rig.csv --scene paper --out recordings/rig
    """
    check_recording("--out", out)
    need("analysis", "mcap", "rosbags", "pyarrow")
    from ..recording.tables.rig_recording import write_measured

    with one_line_errors():
        gearbox = scene_with(scene, set_)
        with busy("converting the table"):
            done = write_measured(table, gearbox, out)
    for line in done.lines(out):
        make_console().one_line(line)
