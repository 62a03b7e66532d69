"""`planetary-twin sweep`: a study over any fields of a scene."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ._arguments import SceneArgument, ToleranceOption
from ._fail import fail, need, remark
from ._settings import changed_scene, settings
from ._study import PICTURES, TABLES, axis, check_suffix, progress, put, warn

if TYPE_CHECKING:
    from ..studies.plan import Study
    from ..studies.sweep import Hearer
    from ..studies.work import Crew, Failure

# Fields of the scene are options, too; click passes on what it does not know.
FIXED = "set"  # is none of them
CONTEXT = {"allow_extra_args": True, "ignore_unknown_options": True}


def sweep(
    context: typer.Context,
    scene: SceneArgument,
    out: Annotated[
        Path, typer.Option(help="Table (.parquet with units, .csv) or picture (.png, .svg, .pdf).")
    ],
    samples: Annotated[
        int | None, typer.Option(help="Draw this many points (Latin hypercube), no grid.")
    ] = None,
    duration: Annotated[float, typer.Option(help="Measured seconds of each run.")] = 0.2,
    settling: Annotated[float, typer.Option(help="Seconds simulated before.")] = 0.05,
    tolerance: ToleranceOption = 1e-4,
    scheduler: Annotated[
        str | None,
        typer.Option(
            metavar="ADDRESS|THREADS",
            help="A Dask cluster, e.g. tcp://10.0.0.1:8786, or a number of threads here.",
            show_default="all cores here",
        ),
    ] = None,
) -> None:
    """Run SCENE at many points: any field of it is an option, with values or a range.

    Values are a list (1000rpm,2000rpm), a grid (1:2:5: five values from 1 to 2) or one of equal
    ratios (0.01:0.1:5:log); with --samples also a range (1:2, 0.01:0.1:log); with a unit each, or
    all in SI. What is done survives a kill: the same command goes on where it was. Fields with a
    dot are given by it: --mesh.damping.loss_factor 0.005:0.02:4; `planetary-twin fields` lists
    them. --set NAME=VALUE, repeatable, changes the scene at all points: --set
    drive.speed_limit=30000rpm.

    Example: planetary-twin sweep paper --backlash 2e-7:3.5e-7:4 --lambda-ratio 1:2:5
    --input-speed 1000rpm,2000rpm --out study.parquet
    """
    check_suffix(out, TABLES + PICTURES)
    from ..studies.plan import Settings, grid, latin_hypercube
    from ..studies.sweep import sweep as run

    try:
        given = list(_fields(context.args))
        fixed = settings([text for name, text in given if name == FIXED])
        loaded = changed_scene(scene, fixed)
        axes = [axis(loaded, field, text) for field, text in given if field != FIXED]
        how = Settings(duration, settling, tolerance=tolerance)
        study = (
            grid(loaded, axes, how)
            if samples is None
            else latin_hypercube(loaded, axes, samples, settings=how)
        )
        journal = out.with_name(f"{out.name}.journal")
        with _crew(scheduler) as crew, _progress(study) as hear:
            table = run(study, crew, journal, hear)
        put(table, out)
        journal.unlink()
    except (ValueError, OSError) as error:
        fail(error)
    for line in _without_effect(study, fixed):
        remark(f"warning: {line}")
    warn(table)
    failed = len(table) - table["failure"].null_count
    typer.echo(f"{out}: {len(table)} points, {failed or 'none'} failed")


def _fields(given: list[str]) -> Iterator[tuple[str, str]]:
    """Names and texts of options that are fields: --mesh.ramp 0:1:3 or --mesh.ramp=0:1:3."""
    rest = iter(given)
    for option in rest:
        name, equals, text = option.removeprefix("--").partition("=")
        if not option.startswith("--") or not name:
            raise ValueError(f"{option!r}: must be --FIELD VALUES")
        if not equals:
            text = next(rest, "")
        if not text:
            raise ValueError(f"{option}: has no values")
        yield name.replace("-", "_"), text


def _without_effect(study: Study, fixed: Iterable[str]) -> Iterator[str]:
    """A line for each field that is given in vain, wherever the study goes."""
    from ..scene.unused import without_effect

    chosen = "lubrication.lambda_ratio"  # which decides of one of them, may vary, too
    names = (*fixed, *study.fields)
    return iter(()) if chosen in study.fields else without_effect(study.scene, names)


@contextmanager
def _crew(scheduler: str | None) -> Iterator[Crew]:
    if scheduler is None or scheduler.isdecimal():
        from ..studies.local import Threads

        yield Threads(None if scheduler is None else int(scheduler))
        return
    need("studies", "distributed")
    from ..studies.cluster import Cluster

    cluster = Cluster(scheduler)
    try:
        yield cluster
    finally:
        cluster.close()


@contextmanager
def _progress(study: Study) -> Iterator[Hearer]:
    with progress("points", len(study.points)) as advance:

        def hear(done: int, failure: Failure | None) -> None:
            advance(done)
            if failure is not None:
                remark(failure.reason)

        yield hear
