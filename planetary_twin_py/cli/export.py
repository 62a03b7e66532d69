"""`planetary-twin export`: a recording as tables for other tools."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..terminal.arguments import FileArgument, NamespaceOption
from ..terminal.console import make_console
from ..terminal.messages import fail, need, remark


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
            "mesh_waveform,axes_state,axes_waveform.",
            show_default="all",
        ),
    ] = "",
    namespace: NamespaceOption = None,
) -> None:
    """Write FILE as tables in SI units: a row per message, or per sample of the waveform.

    Example: planetary-twin export recordings/NAME --out tables --format csv
    """
    need("analysis", "mcap", "rosbags", "pyarrow")
    from rich.progress import Progress

    from ..recording.tables.export import Export
    from ..recording.tables.export import export as write

    console = make_console()
    chosen = Export(out, format_, [name for name in topics.split(",") if name], namespace)
    try:
        with Progress(console=console, transient=True, disable=not console.is_terminal) as progress:
            task = progress.add_task("writing", total=None)
            done = write(
                file, chosen, lambda at, end: progress.update(task, completed=at, total=end)
            )
    except (ValueError, OSError) as error:
        fail(error)
    for line in done.remarks:
        remark(line)
    for path, rows in done.rows.items():
        line = f"{path}: {rows} rows, {path.stat().st_size / 1e6:.1f} MB"
        console.print(line, highlight=False, soft_wrap=True, markup=False)
