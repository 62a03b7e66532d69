"""`planetary-twin export`: a recording as tables for other tools."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..terminal.arguments import FileArgument, NamespaceOption
from ..terminal.console import make_console, progress_of
from ..terminal.messages import need, one_line_errors, remark


def export(
    file: FileArgument,
    out: Annotated[Path, typer.Option(help="Folder; or, for one topic, a file: gears.parquet.")],
    format_: Annotated[
        str | None,
        typer.Option(
            "--format", help="parquet, csv or npz.", show_default="according to the suffix of --out"
        ),
    ] = None,
    topics: Annotated[
        str,
        typer.Option(
            help="Any of gearbox_state,operating_point,joint_states,applied_commands,"
            "mesh_waveform,axes_state,axes_waveform,damage_state,damage_teeth, and topics of "
            "sensors, such as sensors/NAME,thermal_state,measured/vibration.",
            show_default="all",
        ),
    ] = "",
    namespace: NamespaceOption = None,
) -> None:
    """Write FILE as tables in SI units: a row per message, or per sample of the waveform.

    Example: planetary-twin export recordings/NAME --out tables --format csv
    """
    need("analysis", "mcap", "rosbags", "pyarrow")
    from ..recording.tables.export import Export
    from ..recording.tables.export import export as write

    chosen = Export(out, format_, [name for name in topics.split(",") if name], namespace)
    with one_line_errors(), progress_of("writing") as show:
        done = write(file, chosen, show)
    for line in done.remarks:
        remark(line)
    for path, rows in done.rows.items():
        size = path.stat().st_size / 1e6
        make_console().one_line(f"{path}: {rows} rows, {size:.1f} MB")
