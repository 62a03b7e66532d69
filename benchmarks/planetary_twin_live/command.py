"""`planetary-twin bench-live`: jitter, latency, processor share and memory of a live twin."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from planetary_twin_py.terminal.arguments import JsonOption
from planetary_twin_py.terminal.json_output import console_beside, write_json
from planetary_twin_py.terminal.messages import fail


def bench_live(
    duration: Annotated[
        float, typer.Option(help="Duration of each measurement [s].", min=2.0, max=3600.0)
    ] = 20.0,
    memory: Annotated[
        float, typer.Option(help="Duration of the memory measurement [s].", min=2.0)
    ] = 60.0,
    json_: JsonOption = None,
    markdown: Annotated[
        Path | None, typer.Option(help="Write the tables as a page of the documentation.")
    ] = None,
) -> None:
    """
    Measure jitter, latency, processor share and memory of a live twin.

    Example: planetary-twin bench-live --duration 10 --json figures.json
    """
    from .measure import measure
    from .report import as_json, as_markdown, as_tables, remarks

    console = console_beside(json_)
    try:
        with console.status("starting") as status:
            figures = measure(duration, memory, status.update)
        console.print(*as_tables(figures), sep="\n\n", highlight=False)
        console.print(*remarks(figures), sep="\n", highlight=False, soft_wrap=True)
        if markdown is not None:
            command = f"planetary-twin bench-live --duration {duration:g} --memory {memory:g}"
            markdown.write_text(as_markdown(figures, command), "utf-8")
        write_json(as_json(figures), json_)
    except (RuntimeError, ValueError, OSError) as reason:
        fail(reason, 1)
