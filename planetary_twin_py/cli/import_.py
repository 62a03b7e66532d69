"""`planetary-twin import`: converts measurements of a test rig to a recording."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..terminal.arguments import SetOption, complete_scene
from ..terminal.console import busy, make_console
from ..terminal.messages import need, one_line_errors, remark
from ..terminal.output_files import check_recording
from ..terminal.settings import scene_with


def import_(
    table: Annotated[
        Path,
        typer.Argument(
            metavar="TABLE",
            help="CSV, Parquet or MAT file; headings: time [s], power_loss [kW]. With --sensors "
            "also other files with waveforms, such as .wav, .h5, .tdms, .mcap.",
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
    sensors: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.yaml",
            help="What the channels of measured waveforms are: sensors, speed or tachometer.",
        ),
    ] = None,
    set_: SetOption = None,
) -> None:
    """Convert TABLE, the measurements of a test rig, to a recording for `fit` and `view`.

    Each row describes the interval that ends at its time. Columns have the names that `export`
    gives to the fields of gearbox_state and operating_point. With --sensors, TABLE has waveforms,
    and the recording has a topic for each sensor, for `spectrum`, `indicators`, `view` and
    `follow`.

    Example: planetary-twin import rig.csv --scene paper --out recordings/rig
    """
    check_recording("--out", out)
    need("analysis", "mcap", "rosbags", "pyarrow")
    if sensors is not None:
        _import_waveforms(table, sensors, scene, set_, out)
        return
    from ..recording.tables.rig_recording import write_measured

    with one_line_errors():
        gearbox = scene_with(scene, set_)
        with busy("converting the table"):
            done = write_measured(table, gearbox, out)
    for line in done.lines(out):
        make_console().one_line(line)


def _import_waveforms(
    table: Path, sensors: Path, scene: str, set_: list[str] | None, out: Path
) -> None:
    from ..analysis.signals.imported_waveforms import import_waveforms
    from ..analysis.signals.waveform_map import read_map

    with one_line_errors():
        gearbox, given = scene_with(scene, set_), read_map(sensors)
        with busy("converting the waveforms"):
            done = import_waveforms(table, given, gearbox, out)
    for line in done.remarks:
        remark(line)
    for line in done.lines(out):
        make_console().one_line(line)
