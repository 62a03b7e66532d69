"""`planetary-twin fit`: estimates scene parameters from a recording."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..terminal.arguments import FileArgument, JsonOption, NamespaceOption, file_option
from ..terminal.dataclass_options import take_options_of
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import need, one_line_errors
from ..terminal.output_files import writing
from ..terminal.unit_options import SECONDS
from ._fit_course import fit_manoeuvre
from ._fit_points import fit_points
from ._fit_texts import field_names, free_fields, held_out_span, noise_levels
from ._fitted import Fitted, Part
from ._follow_inputs import ScaleOption, SensorsOption, described_sensors

if TYPE_CHECKING:
    from ..studies.fit.identify import Search


@dataclass(frozen=True)
class Options:
    """Arguments and options of the command."""

    file: FileArgument
    free: Annotated[
        str,
        typer.Option(
            metavar="NAMES",
            help="Fields to estimate, separated by commas; NAME=VALUE sets the initial value, "
            "otherwise the recorded value.",
        ),
    ]
    from_: Annotated[
        float | None, typer.Option("--from", help="Start in simulated time.", **SECONDS)
    ] = None
    to: Annotated[float | None, typer.Option(help="End in simulated time.", **SECONDS)] = None
    observe: Annotated[
        str | None,
        typer.Option(
            metavar="NAMES",
            help="Measured quantities of a recording, separated by commas. Default: dte_rms and "
            "power_loss, as far as they were recorded.",
        ),
    ] = None
    noise: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME=VALUE", help="Standard deviation of one reading, in SI. Repeatable."
        ),
    ] = None
    hold_out: Annotated[
        str | None,
        typer.Option(
            metavar="FROM:TO",
            help="Another part in simulated seconds that is predicted with intervals and not "
            "fitted.",
        ),
    ] = None
    scene: Annotated[
        str | None,
        typer.Option(metavar="SCENE", help="Scene of the gearbox, if FILE is a manoeuvre."),
    ] = None
    sensors: SensorsOption = None
    scale: ScaleOption = None
    report: Annotated[
        Path | None, file_option("Write a report: .html, or .md and pictures.", ".md", ".html")
    ] = None
    namespace: NamespaceOption = None
    json_: JsonOption = None


def fit(**given: Any) -> None:
    """Estimate scene parameters from FILE with confidence intervals, if they are identifiable.

    FILE is a recording, or a measured manoeuvre: a .csv, .parquet or .mat file with time,
    input_torque, output_torque and input_speed or output_speed. --sensors and --scale are for
    these, as in `follow`; readings that contradict the scene end the command and ask for units
    and signs.

    Of a recording, without --from and --to, up to one second with a constant operating point is
    used. Parameters that the readings do not determine are reported in a warning; the exit code is
    still 0.

    Example: planetary-twin fit recordings/NAME --free lambda_ratio,input_torque
    """
    asked = Options(**given)
    need("recording", "mcap", "rosbags")
    if asked.report is not None:
        need("plots", "matplotlib")
    with one_line_errors(ArithmeticError):
        found = _fitted(asked)
    write_json(found.figures, asked.json_)
    if asked.report is not None:
        from ..plots.fit_report import write_report

        with writing("--report", asked.report):
            write_report(asked.report, found.report())


take_options_of(Options, fit)


def _fitted(asked: Options) -> Fitted:
    """Fit a manoeuvre or a recording, and print the estimates."""
    from ..recording.container.suffixes import is_table

    file, console = asked.file, console_beside(asked.json_)
    manoeuvre = is_table(file)
    if manoeuvre:
        need("analysis", "pyarrow")
    free = free_fields(asked.free)
    part = Part(asked.from_, asked.to, held_out_span(asked.hold_out))
    if manoeuvre:
        _refuse(f"{file} is a manoeuvre", {"--observe": asked.observe, "--noise": asked.noise})
        known = described_sensors(asked.sensors, asked.scale or [])
        return fit_manoeuvre(console, file, asked.scene, free, part, known)
    options = {"--scene": asked.scene, "--sensors": asked.sensors, "--scale": asked.scale}
    _refuse(f"{file} is a recording", options)
    search = _search(free, asked.observe, asked.noise or [])
    return fit_points(console, file, asked.namespace, search, part)


def _refuse(why: str, options: Mapping[str, object]) -> None:
    """Refuse options that have no effect."""
    for name, value in options.items():
        if value:
            raise ValueError(f"{name}: has no effect, because {why}")


def _search(given: Mapping[str, str], observe: str | None, noise: Sequence[str]) -> Search:
    from ..studies.fit.identify import Search

    return Search(
        free=tuple(given),
        observe=None if observe is None else field_names(observe),
        start={name: value for name, value in given.items() if value},
        noise=noise_levels(noise),
    )
