"""`planetary-twin sweep`: a parameter study over any fields of a scene."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Annotated

import typer

from ..terminal.arguments import (
    EvaluatedOption,
    SceneArgument,
    SettlingOption,
    StudyOut,
    ToleranceOption,
)
from ..terminal.messages import one_line_errors, warn
from ..terminal.settings import changed_scene, settings
from ..units.catalogue import AXES_RESULTS, STUDY_RESULTS
from ._study import axis, computed, need_packages, warn_of, write_results

if TYPE_CHECKING:
    import pyarrow as pa

    from ..scene import Scene
    from ..studies.axes import Axis, Normal, Span


# Options that click does not know are fields of the scene.
FIXED = "set"  # not a field
CONTEXT = {"allow_extra_args": True, "ignore_unknown_options": True}


def sweep(  # noqa: PLR0913 - an argument for each option
    context: typer.Context,
    scene: SceneArgument,
    out: StudyOut,
    samples: Annotated[
        int | None, typer.Option(help="Number of Latin hypercube samples, in place of a grid.")
    ] = None,
    duration: EvaluatedOption = 0.2,
    settling: SettlingOption = 0.05,
    tolerance: ToleranceOption = 1e-4,
    y: Annotated[
        str | None,
        typer.Option(
            "--y",
            metavar="MEASURE,...",
            help="Columns of the picture, and of the summary of a distribution.",
            show_default="main results",
        ),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(
            metavar="ADDRESS|THREADS",
            help="Address of a Dask scheduler, e.g. tcp://10.0.0.1:8786, or number of threads.",
            show_default="a thread per core",
        ),
    ] = None,
) -> None:
    """Simulate SCENE at many points; each field of the scene is an option with values or a range.

    Values are a list (1000rpm,2000rpm), a linear grid (1:2:5 is five values from 1 to 2), a
    logarithmic grid (0.01:0.1:5:log) or, with --samples, a range (1:2, 0.01:0.1:log) or a normal
    distribution (normal(0 um,5 um); of a list with a value for each planet, it draws each), which
    ends with percentiles and is drawn as a histogram. Give every number a unit, or all in SI.
    Write nested fields with dots: --mesh.damping.loss_factor 0.005:0.02:4; `planetary-twin fields`
    lists them. --set NAME=VALUE changes the scene at all points and is repeatable: --set
    drive.speed_limit=30000rpm. To resume an interrupted study, repeat the command.

    Example: planetary-twin sweep paper --backlash 2e-7:3.5e-7:4 --lambda-ratio 1:2:5
    --input-speed 1000rpm,2000rpm --out study.parquet
    """
    need_packages(out)
    from ..scene.unused import without_effect_in_all
    from ..studies.axes import Normal
    from ..studies.distribution import usual_measures
    from ..studies.plan import Settings, grid, latin_hypercube

    with one_line_errors():
        given = list(_fields(context.args))
        fixed = settings([text for name, text in given if name == FIXED])
        loaded = changed_scene(scene, fixed)
        loaded, axes = _varied(loaded, given)
        measures = _measures(y)
        how = Settings(duration, settling, tolerance=tolerance)
        study = (
            grid(loaded, axes, how)
            if samples is None
            else latin_hypercube(loaded, axes, samples, settings=how)
        )
        drawn = any(isinstance(each, Normal) for each in axes)
        with computed(study, out, scheduler) as table:
            if drawn:
                measures = measures or [*usual_measures(table)]
            write_results(table, out, measures=measures, kind="histogram" if drawn else None)
    scenes = study.extremes()
    warn(without_effect_in_all(scenes, (*fixed, *study.fields)))
    warn_of(table, scenes)
    if drawn:
        _print_distributions(table, measures)
    failed = len(table) - table["failure"].null_count
    typer.echo(f"{out}: {len(table)} points, {failed or 'none'} failed")


def _varied(
    scene: Scene, given: Sequence[tuple[str, str]]
) -> tuple[Scene, list[Axis | Span | Normal]]:
    """The scene with a value for each planet where one varies, and the fields that vary."""
    from ..studies.axes import planet_by_planet

    axes = []
    for field, text in given:
        if field != FIXED:
            scene, entries = planet_by_planet(scene, field, text)
            axes += [axis(scene, entry, text) for entry in entries]
    return scene, axes


def _measures(text: str | None) -> list[str]:
    """Names of results from the option --y."""
    from ..scene.names import did_you_mean

    names = text.split(",") if text else []
    for name in names:
        if name not in STUDY_RESULTS | AXES_RESULTS:
            known = [*STUDY_RESULTS, *AXES_RESULTS]
            raise ValueError(
                f"--y = {name!r}: must be one of {', '.join(known)}{did_you_mean(name, known)}"
            )
    return names


def _fields(given: list[str]) -> Iterator[tuple[str, str]]:
    """Names and texts of field options: --mesh.ramp 0:1:3 or --mesh.ramp=0:1:3."""
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


def _print_distributions(study: pa.Table, names: Sequence[str]) -> None:
    """Print mean, standard deviation and percentiles of results."""
    from ..studies.distribution import SHARES, distributions
    from ..terminal.console import make_console
    from ..terminal.tables import table
    from ..units.engineering import figure

    found = distributions(study, names)
    shares = [s for s in SHARES if any(s in each.percentiles for each in found)]
    columns = []
    for each in found:
        unit = (STUDY_RESULTS | AXES_RESULTS)[each.name].si
        values = (each.mean, each.deviation, *map(each.percentiles.get, shares))
        columns.append(["-" if value is None else figure(value, unit) for value in values])
    statistics = ("mean", "standard deviation", *(f"{share:g} %" for share in shares))
    headings = ("", *(each.name.replace("_", " ") for each in found))
    caption = "Percentiles are left out where fewer than five points are beyond them"
    rows = zip(statistics, *columns, strict=True)
    make_console().print(table(headings, rows, caption=caption))
