"""`planetary-twin plot`: a study's table as a picture."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ._fail import fail, remark
from ._study import PICTURES, TABLES, check_suffix, put


def plot(
    study: Annotated[
        Path, typer.Argument(metavar="STUDY", help="Table of a study, .parquet or .csv.")
    ],
    out: Annotated[Path, typer.Option(help="Picture: .png, .svg or .pdf.")],
    x: Annotated[str | None, typer.Option("--x", metavar="FIELD", help="Horizontal axis.")] = None,
    y: Annotated[
        str | None,
        typer.Option("--y", metavar="MEASURE,...", help="What to draw, a panel for each."),
    ] = None,
    by: Annotated[
        str | None,
        typer.Option(metavar="FIELD", help="Told apart by colour; vertical axis of a map."),
    ] = None,
    kind: Annotated[
        str | None,
        typer.Option(help="curves, map or stribeck.", show_default="what the fields ask for"),
    ] = None,
) -> None:
    """Draw what `sweep`, `stribeck` or `bifurcation` has found, in the engineer's units.

    Without options: curves where one field varies, a curve for each value of a second one, a
    panel for each value of a third; a map where two have six values or more.

    Example: planetary-twin plot study.parquet --y efficiency,power_loss --out study.svg
    """
    check_suffix(out, PICTURES)
    if study.suffix not in TABLES:
        fail(f"STUDY = {str(study)!r}: must end in {', '.join(TABLES)}")
    if not study.is_file():
        fail(f"STUDY = {str(study)!r}: no such file")
    from ..plots.study import failures
    from ..studies.table import read

    try:
        table = read(study)
    except (ValueError, OSError) as error:
        fail(f"{study}: {str(error).splitlines()[0]}")
    measures = y.split(",") if y else ()
    try:
        put(table, out, x, measures, by, kind)
    except (ValueError, OSError) as error:
        fail(error)
    if failed := failures(table):
        remark(f"{failed} of {len(table)} points failed and are left out")
    typer.echo(f"{out}")
