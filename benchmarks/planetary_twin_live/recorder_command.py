"""`planetary-twin bench-recorder`: the highest rate that the logger records without loss."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from planetary_twin_py.terminal.arguments import JsonOption
from planetary_twin_py.terminal.json_output import console_beside, write_json
from planetary_twin_py.terminal.messages import fail

if TYPE_CHECKING:
    from rich.table import Table

    from .recorder import Throughput


def bench_recorder(
    duration: Annotated[
        float, typer.Option(help="Duration of each rate [s].", min=1.0, max=600.0)
    ] = 4.0,
    directory: Annotated[
        Path, typer.Option(help="Folder on the disk to measure; its new files are deleted.")
    ] = Path("."),
    json_: JsonOption = None,
) -> None:
    """
    Find the highest rate that is recorded without loss, for small and large messages.

    Example: planetary-twin bench-recorder --directory recordings
    """
    from .recorder import measure

    console = console_beside(json_)
    try:
        with console.status("starting") as status:
            found = measure(duration, directory, status.update)
        console.print(_table(found))
        write_json([_plain(row) for row in found], json_)
    except (RuntimeError, ValueError, OSError) as reason:
        fail(reason, 1)


def _table(found: list[Throughput]) -> Table:
    from rich.table import Table

    table = Table(box=None, pad_edge=False)
    titles = (
        "bytes", "messages/s", "MB/s", "of a core", "on disk p50", "max", "limited by",
        "bare writer/s",
    )  # fmt: skip
    for title in titles:
        table.add_column(title, justify="right")
    for row in found:
        best = row.best
        table.add_row(
            f"{row.size}", f"{best.rate:.0f}", f"{row.megabytes:.1f}", f"{best.cores:.0%}",
            f"{best.latency.p50:.2f} s", f"{best.latency.max:.2f} s", row.limit,
            f"{row.bare_rate:.0f}",
        )  # fmt: skip
    return table


def _plain(row: Throughput) -> dict[str, Any]:
    best = row.best._asdict() | {"latency": row.best.latency._asdict()}
    return row._asdict() | {"best": best, "megabytes_per_s": row.megabytes}
