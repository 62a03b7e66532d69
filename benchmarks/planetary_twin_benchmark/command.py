"""`planetary-twin bench`: computing time against error."""

from __future__ import annotations

import math
import os
from pathlib import Path
from typing import Annotated

import typer

from planetary_twin_py.terminal.arguments import JsonOption
from planetary_twin_py.terminal.json_output import console_beside, write_json
from planetary_twin_py.terminal.messages import fail, need, warn
from planetary_twin_py.terminal.output_files import output_file, writing


def bench(
    json_: JsonOption = None,
    markdown: Annotated[
        Path | None,
        typer.Option(
            metavar="NAME.md",
            help="Write a page of the documentation; with --quick, the table into a page.",
            callback=output_file,
        ),
    ] = None,
    plot: Annotated[
        Path | None,
        typer.Option(metavar="FILE.png", help="Draw error against time.", callback=output_file),
    ] = None,
    costs: Annotated[
        bool,
        typer.Option(
            "--costs", help="Also measure how time depends on terms, planets, speed and duration."
        ),
    ] = False,
    peers: Annotated[
        bool,
        typer.Option("--peers", help="Also measure general-purpose solvers (about 25 minutes)."),
    ] = False,
    quick: Annotated[
        bool,
        typer.Option(
            "--quick", help="Only the table of the README, with CVODE: at most two minutes."
        ),
    ] = False,
) -> None:
    """Measure computing time against error; the reference is a converged run of SciPy's DOP853.

    Example: planetary-twin bench --plot speed.png --json figures.json
    """
    if quick:
        if costs or peers or plot is not None:
            fail("--quick: has one table, so no --costs, --peers or --plot")
        _quick(json_, markdown)
        return
    if peers:
        need("bench", "CyRK", "sksundae")
    if plot is not None:
        need("plots", "matplotlib")

    from .batch import batch_markdown, batch_table, measure_batch
    from .cases import CASES, PLANAR_CASES
    from .costs import cost_markdown, cost_tables, measure_costs
    from .equal_error import equal_error_markdown
    from .peers.problem import Problem
    from .peers.work_precision import peer_rows
    from .report import as_markdown, as_table
    from .steady import measure_steady, steady_markdown, steady_table
    from .table import measure, nothing

    console = console_beside(json_)
    with console.status("starting") as status:
        beside = peer_rows(status.update) if peers else nothing
        rows = measure(CASES, progress=status.update, beside=beside)
        steady = measure_steady((*CASES, *PLANAR_CASES), progress=status.update)
        batches = measure_batch(progress=status.update)
        dear = measure_costs(progress=status.update) if costs else []
    console.print(as_table(rows))
    console.print(steady_table(steady), batch_table(batches), *cost_tables(dear), sep="\n\n")
    if peers:
        call = Problem(CASES[0].scene()).seconds_per_call()
        console.print(f"right-hand side of the peers: {call * 1e9:.0f} ns a call ({CASES[0].name})")
    if plot is not None:
        from planetary_twin_py.plots.style import save

        from .work_precision import work_precision

        with writing("--plot", plot):
            save(work_precision(rows), str(plot))
    if markdown is not None:
        picture = os.path.relpath(plot, markdown.parent) if plot is not None else None
        page = as_markdown(rows, picture, equal_error_markdown(rows, steady))
        page += steady_markdown(steady) + batch_markdown(batches)
        markdown.write_text(page + (cost_markdown(dear) if dear else ""), "utf-8")
    if json_ is not None:
        minutes = [row for row in steady if not math.isnan(row.repeats_from)]
        figures = [row.figures() for row in rows] + [row.figures() for row in minutes]
        write_json(figures, json_)


def _quick(json_: str | None, markdown: Path | None) -> None:
    """Measure the table of the README."""
    from .machine import busy
    from .quick import QUICK_CASES, measure_quick
    from .quick_table import into_page, quick_table

    warn([busy()])
    console = console_beside(json_)
    with console.status("starting") as status:
        rows = measure_quick(QUICK_CASES, progress=status.update)
    console.print(quick_table(rows))
    if markdown is not None:
        page = markdown.read_text("utf-8") if markdown.exists() else ""
        markdown.write_text(into_page(page, rows), "utf-8")
    write_json([figures for row in rows for figures in row.figures()], json_)
