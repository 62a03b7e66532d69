"""`planetary-twin recover`: copies the intact parts of a damaged recording."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..terminal.arguments import FileArgument
from ..terminal.console import busy, make_console
from ..terminal.messages import fail, need, one_line_errors, remark
from ..terminal.names import shown
from ..terminal.output_files import check_recording


def recover(
    file: FileArgument,
    folder: Annotated[
        Path | None, typer.Argument(metavar="[OUT]", help="Deprecated: use --out.")
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(help="New folder.", show_default="name of FILE with _whole, beside FILE"),
    ] = None,
) -> None:
    """Copy the intact messages of FILE, which may be truncated or damaged, to a valid recording.

    Reports what is missing: bytes, time intervals, chunks, and messages if the index lists them.

    Example: planetary-twin recover recordings/paper_20260101_120000 --out recordings/saved
    """
    need("recording", "mcap", "rosbags")
    from ..recording.ros2.recover import recover as save
    from ..recording.runs.info import read_info
    from ..terminal.tables import table

    if out is not None and folder is not None:
        fail(f"--out = {str(out)!r}: the argument {str(folder)!r} names another folder")
    folder = out or folder or file.with_name(f"{file.stem}_whole")
    check_recording("--out", folder)
    with one_line_errors(), busy("copying intact messages"):
        saved = save(file, folder)
        remarks = [*saved.remarks, *read_info(saved.file).remarks]
    for line in remarks or ["no damage found: the copy is complete"]:
        remark(line)
    console = make_console()
    rows = ([shown(topic), str(count)] for topic, count in saved.messages.items())
    console.print(table(("topic", "messages saved"), rows, framed=False))
    console.one_line(f"{saved.file}")
