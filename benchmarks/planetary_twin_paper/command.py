"""`planetary-twin paper`: recomputes every table and figure of the paper."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from planetary_twin_py.terminal.arguments import JsonOption
from planetary_twin_py.terminal.json_output import console_beside, write_json
from planetary_twin_py.terminal.messages import fail, need
from planetary_twin_py.terminal.output_files import PICTURES

if TYPE_CHECKING:
    from rich.table import Table

    from .entry import Entry


def paper(
    out: Annotated[
        Path, typer.Option(help="Page to write; its pictures go into a folder of the same name.")
    ] = Path("docs/paper.md"),
    pictures: Annotated[str, typer.Option(help="Format of the pictures: png, svg or pdf.")] = "png",
    json_: JsonOption = None,
    jobs: Annotated[int, typer.Option(min=1, max=64, help="Number of processes.")] = 2,
) -> None:
    """Recompute every table and figure of the paper, and compare them with the published ones.

    Example: planetary-twin paper --out paper.md --pictures svg
    """
    if out.suffix != ".md":
        fail(f"--out = {str(out)!r}: must end in .md")
    if f".{pictures}" not in PICTURES:
        fail(f"--pictures = {pictures!r}: must be png, svg or pdf")
    need("plots", "matplotlib")
    from rich.progress import Progress

    from .evidence import gather
    from .page import figures, write_page
    from .report import BUILDERS, entries
    from .study import Grid

    try:
        out.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        fail(f"--out = {str(out)!r}: {error.strerror}")
    console = console_beside(json_)
    with Progress(console=console, transient=True) as progress:
        evidence = gather(
            Grid(),
            jobs,
            lambda runs, count: progress.track(runs, count, description="running the study"),
        )
        task = progress.add_task("tables and figures", total=len(BUILDERS))
        found = entries(evidence, lambda _: progress.advance(task))
        try:
            write_page(found, evidence, out, f".{pictures}")
        except OSError as error:
            fail(f"--out = {str(out)!r}: {error.strerror}")
    console.print(_table(found))
    console.print(f"{out}")
    write_json(figures(found, evidence), json_)


def _table(entries: list[Entry]) -> Table:
    from rich.table import Table

    table = Table("", "title", "verdict", box=None, header_style="bold", pad_edge=False)
    for entry in entries:
        table.add_row(entry.number, entry.title, entry.verdict.text)
    return table
