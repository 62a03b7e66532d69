"""`planetary-twin bench`: speed against error."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Annotated

import typer


def bench(
    json_: Annotated[
        str | None, typer.Option("--json", metavar="FILE", help="Write figures; - prints them.")
    ] = None,
) -> None:
    """Measure speed against error, beside a converged reference by SciPy's DOP853."""
    from rich.console import Console
    from rich.table import Table

    from ..benchmark.cases import CASES
    from ..benchmark.table import measure

    console = Console(stderr=json_ == "-")
    with console.status("starting") as status:
        rows = measure(CASES, progress=status.update)
    table = Table(box=None, header_style="bold", pad_edge=False)
    table.add_column("case", no_wrap=True)
    for title in ("tolerance", "error DTE", "error loss", "x real time", "spread", "set-up"):
        table.add_column(title, justify="right", no_wrap=True)
    for row in rows:
        table.add_row(
            row.case, f"{row.tolerance:.0e}", f"{row.error_dte:.1e}",
            f"{row.error_power_loss:.1e}", f"{row.rtf:.2f}",
            f"{row.rtf_low:.1f}-{row.rtf_high:.1f}", f"{row.setup_s * 1e3:.0f} ms",
        )  # fmt: skip
    console.print(table)
    if json_ is not None:
        text = json.dumps([row._asdict() for row in rows], indent=2) + "\n"
        sys.stdout.write(text) if json_ == "-" else Path(json_).write_text(text, "utf-8")
