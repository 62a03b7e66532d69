"""`planetary-twin plot`: draws the table of a study."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..terminal.arguments import StudyPicture
from ..terminal.messages import fail, one_line_errors, remark
from ..terminal.output_files import STUDY_TABLES
from ._study import need_packages, write_results


def plot(
    study: Annotated[
        Path, typer.Argument(metavar="STUDY", help="Table of a study, .parquet or .csv.")
    ],
    out: StudyPicture,
    x: Annotated[str | None, typer.Option("--x", metavar="FIELD", help="Horizontal axis.")] = None,
    y: Annotated[
        str | None,
        typer.Option("--y", metavar="MEASURE,...", help="Columns to draw, one panel each."),
    ] = None,
    by: Annotated[
        str | None,
        typer.Option(
            metavar="FIELD", help="Field shown by colour; in a map, on the vertical axis."
        ),
    ] = None,
    kind: Annotated[
        str | None,
        typer.Option(
            help="curves, map, points, histogram or stribeck.",
            show_default="according to the fields",
        ),
    ] = None,
) -> None:
    """Draw the results of `sweep`, `stribeck` or `bifurcation` in customary units.

    By default: curves over the first field that varies, one curve per value of a second field,
    one panel per value of a third; a map if two fields have six values or more; the points over
    each field if more than three vary.

    Example: planetary-twin plot study.parquet --y efficiency,power_loss --out study.svg
    """
    need_packages(out)
    if study.suffix not in STUDY_TABLES:
        fail(f"STUDY = {str(study)!r}: must end in {', '.join(STUDY_TABLES)}")
    if not study.is_file():
        fail(f"STUDY = {str(study)!r}: no such file")
    from ..plots.study import failures
    from ..studies.table import read

    try:
        table = read(study)
    except (ValueError, OSError) as error:
        fail(f"{study}: {str(error).splitlines()[0]}")
    with one_line_errors():
        write_results(table, out, x, y.split(",") if y else (), by, kind)
    if failed := failures(table):
        remark(f"{failed} of {len(table)} points failed and are omitted")
    typer.echo(f"{out}")
