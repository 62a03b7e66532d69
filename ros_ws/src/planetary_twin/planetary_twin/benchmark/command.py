"""`planetary-twin bench-live`: how punctual a live twin is, and what it costs."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Annotated

import typer


def bench_live(
    duration: Annotated[
        float, typer.Option(help="Of each measurement [s].", min=2.0, max=3600.0)
    ] = 20.0,
    memory: Annotated[
        float, typer.Option(help="Of the measurement of the memory [s].", min=2.0)
    ] = 60.0,
    json_: Annotated[
        str | None, typer.Option("--json", metavar="FILE", help="Write figures; - prints them.")
    ] = None,
    markdown: Annotated[
        Path | None, typer.Option(help="Write the tables as a page of the documentation.")
    ] = None,
) -> None:
    """Measure jitter, latency, processor share and memory of a live twin."""
    from rich.console import Console

    from .measure import measure
    from .report import as_json, as_markdown, as_tables, remarks

    console = Console(stderr=json_ == "-")
    try:
        with console.status("starting") as status:
            figures = measure(duration, memory, status.update)
        console.print(*as_tables(figures), sep="\n\n", highlight=False)
        console.print(*remarks(figures), sep="\n", highlight=False, soft_wrap=True)
        if markdown is not None:
            command = f"planetary-twin bench-live --duration {duration:g} --memory {memory:g}"
            markdown.write_text(as_markdown(figures, command), "utf-8")
        if json_ is not None:
            text = json.dumps(as_json(figures), indent=2) + "\n"
            sys.stdout.write(text) if json_ == "-" else Path(json_).write_text(text, "utf-8")
    except KeyboardInterrupt:
        raise typer.Exit(130) from None
    except (ValueError, OSError) as reason:
        print(f"planetary-twin bench-live: {reason}", file=sys.stderr)
        raise typer.Exit(1) from None
