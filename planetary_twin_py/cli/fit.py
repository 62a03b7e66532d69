"""`planetary-twin fit`: estimates scene parameters from a recording."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..terminal.arguments import FileArgument, JsonOption, NamespaceOption
from ..terminal.durations import SECONDS
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, need, remark
from ..terminal.output_files import file_ending_in
from ..terminal.settings import settings

if TYPE_CHECKING:
    from rich.console import Console

    from ..studies.fit.identify import Identified
    from ..studies.fit.report import Report


def fit(  # noqa: PLR0913 - an argument for each option
    file: FileArgument,
    free: Annotated[
        str,
        typer.Option(
            metavar="NAMES",
            help="Fields to estimate, separated by commas; NAME=VALUE sets the initial value, "
            "otherwise the recorded value.",
        ),
    ],
    from_: Annotated[
        float | None, typer.Option("--from", help="Start in simulated time.", **SECONDS)
    ] = None,
    to: Annotated[float | None, typer.Option(help="End in simulated time.", **SECONDS)] = None,
    observe: Annotated[
        str, typer.Option(metavar="NAMES", help="Measured quantities, separated by commas.")
    ] = "dte_rms,power_loss",
    noise: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME=VALUE", help="Standard deviation of one reading, in SI. Repeatable."
        ),
    ] = None,
    hold_out: Annotated[
        str | None,
        typer.Option(
            metavar="FROM:TO",
            help="Another part in simulated seconds that is predicted with intervals and not "
            "fitted.",
        ),
    ] = None,
    scene: Annotated[
        str | None,
        typer.Option(metavar="SCENE", help="Scene of the gearbox, if FILE is a manoeuvre."),
    ] = None,
    report: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Write a report: .html, or .md and pictures.",
            callback=file_ending_in(".md", ".html"),
        ),
    ] = None,
    namespace: NamespaceOption = None,
    json_: JsonOption = None,
) -> None:
    """Estimate scene parameters from FILE with confidence intervals, if they are identifiable.

    FILE is a recording, or a measured manoeuvre: a .csv, .parquet or .mat file with time,
    input_torque, output_torque and input_speed.

    Of a recording, without --from and --to, up to one second with a constant operating point is
    used. Parameters that the readings do not determine are reported in a warning; the exit code is
    still 0.

    Example: planetary-twin fit recordings/NAME --free lambda_ratio,input_torque
    """
    need("recording", "mcap", "rosbags")
    if report is not None:
        need("plots", "matplotlib")

    from ..recording.tables.suffixes import SUFFIXES
    from ..studies.fit.identify import Search, identify
    from ..studies.fit.remarks import remarks

    console = console_beside(json_)
    if file.suffix in SUFFIXES:
        need("analysis", "pyarrow")
        _manoeuvre(console, file, scene, free, (from_, to, hold_out), (report, json_))
        return
    try:
        search = Search(
            free=tuple(name for name, _ in map(_pair, _parts(free))),
            observe=tuple(map(_name, _parts(observe))),
            start={name: value for name, value in map(_pair, _parts(free)) if value},
            noise=_numbers(noise or []),
        )
        with console.status("simulating") as status:
            found = identify(
                file, search, namespace, from_, to,
                report=lambda count: status.update(f"{count} simulations"),
                hold_out=_span(hold_out),
            )  # fmt: skip
    except (ValueError, ArithmeticError, OSError) as error:
        fail(error)
    warnings = list(remarks(found))
    _print(console, found)
    for line in warnings:
        remark(f"warning: {line}")
    write_json(_figures(found) | {"remarks": warnings}, json_)
    if report is not None:
        from ..studies.fit.report import report_of_points

        _write_report(report, report_of_points(found))


def _manoeuvre(
    console: Console,
    file: Path,
    scene: str | None,
    free: str,
    parts: tuple[float | None, float | None, str | None],
    out: tuple[Path | None, str | None],
) -> None:
    """Fit a manoeuvre; `parts` are --from, --to and --hold-out, `out` is --report and --json."""
    from ._fit_course import course_figures, fit_manoeuvre

    begin, end, hold_out = parts
    try:
        given = dict(map(_pair, _parts(free)))
        span = _span(hold_out)
        found, warnings = fit_manoeuvre(console, file, scene, given, (begin, end), span)
    except (ValueError, ArithmeticError, OSError) as error:
        fail(error)
    write_json(course_figures(found, warnings), out[1])
    if out[0] is not None:
        from ..studies.fit.report import report_of_course

        _write_report(out[0], report_of_course(found))


def _write_report(path: Path, report: Report) -> None:
    from ..studies.fit.report import write_report

    try:
        write_report(path, report)
    except (ValueError, OSError) as error:
        fail(f"--report = {str(path)!r}: {error}")


def _name(text: str) -> str:
    return text.strip().replace("-", "_")


def _parts(text: str) -> list[str]:
    return [part for part in text.split(",") if part.strip()]


def _pair(text: str) -> tuple[str, str]:
    name, _, value = text.partition("=")
    return _name(name), value.strip()


def _span(text: str | None) -> tuple[float, float] | None:
    if text is None:
        return None
    try:
        begin, end = map(float, text.split(":"))
    except ValueError:
        raise ValueError(f"--hold-out = {text!r}: must be FROM:TO in seconds") from None
    if not 0.0 <= begin < end < math.inf:
        raise ValueError(f"--hold-out = {text!r}: FROM must be at least 0 and below TO")
    return begin, end


def _numbers(given: list[str]) -> dict[str, float]:
    found = {}
    for name, value in settings(given).items():
        try:
            found[_name(name)] = float(value)
        except ValueError:
            raise ValueError(f"--noise {name} = {value!r}: must be a number in SI") from None
    return found


def _print(console: Console, found: Identified) -> None:
    from rich.table import Table

    excerpt, estimate = found.excerpt, found.estimate
    table = Table(title=f"{excerpt.scene.name}, {excerpt.start:g} to {excerpt.end:g} s")
    for heading in (
        "field",
        "estimate",
        f"{100.0 * found.confidence:g} % interval",
        "unit",
        "from",
    ):
        table.add_column(heading, justify="right")
    for k, parameter in enumerate(found.parameters):
        low, high, profiled = estimate.intervals[k]
        identifiable = estimate.identifiable(k)
        source = ("profile" if profiled else "curvature") if identifiable else "search range"
        value = f"{estimate.values[k]:.6g}" if identifiable else "not identifiable"
        span = f"{low:.6g} to {high:.6g}"
        if math.isnan(low):
            span, source = "-", "combination only"
        table.add_row(parameter.name, value, span, parameter.unit, source)
    console.print(table)
    for one in found.predictions:
        console.print(
            f"held out: {one.name} at {len(one.measured)} operating points: rms error "
            f"{100.0 * one.rms:.3g} %, {100.0 * one.inside:.3g} % within their "
            f"{100.0 * found.confidence:g} % intervals",
            highlight=False,
        )
    console.print(f"{found.simulations} simulations in {found.wall_time:.1f} s", highlight=False)


def _figures(found: Identified) -> dict[str, Any]:
    """Results for `--json`; "told" and "untold" are deprecated names, kept for compatibility."""
    estimate = found.estimate
    parameters = {
        p.name: {
            "estimate": float(estimate.values[k]) if estimate.identifiable(k) else None,
            "low": _finite(estimate.intervals[k].low),
            "high": _finite(estimate.intervals[k].high),
            "unit": p.unit,
            "identifiable": estimate.identifiable(k),
            "told": estimate.identifiable(k),
            "at_bound": estimate.at_bound[k],
            "profiled": estimate.intervals[k].profiled,
        }
        for k, p in enumerate(found.parameters)
    }
    groups = [[found.parameters[k].name for k in group] for group in estimate.not_identifiable]
    return {
        "parameters": parameters,
        "confidence": found.confidence,
        "correlation": [[_finite(value) for value in row] for row in estimate.correlation],
        "not_identifiable": groups,
        "untold": groups,
        "excess": estimate.excess,
        "noise": {
            readings.name: _finite(float(noise.reading.max()))
            for readings, noise in zip(found.weighted.recorded, found.weighted.noise, strict=True)
        },
        "predictions": {
            one.name: {
                "measured": one.measured.tolist(),
                "predicted": one.predicted.tolist(),
                "reach": one.reach.tolist(),
                "rms": _finite(one.rms),
                "inside": one.inside,
            }
            for one in found.predictions
        },
        "contact_fraction": found.contact_fraction,
        "from_s": found.excerpt.start,
        "to_s": found.excerpt.end,
        "simulations": found.simulations,
        "wall_time_s": found.wall_time,
    }


def _finite(value: float) -> float | None:
    """`value`, or None in place of an infinity or NaN, which JSON lacks."""
    return float(value) if math.isfinite(value) else None
