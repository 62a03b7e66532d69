"""`planetary-twin fit`: estimates scene parameters from a recording."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..terminal.arguments import FileArgument, JsonOption, NamespaceOption
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, need
from ..terminal.output_files import file_ending_in, writing
from ..terminal.unit_options import SECONDS
from ._fit_course import fit_manoeuvre
from ._fit_points import fit_points
from ._fit_texts import field_names, free_fields, held_out_span, noise_levels
from ._fitted import Part
from ._follow_inputs import ScaleOption, SensorsOption, described_sensors

if TYPE_CHECKING:
    from ..studies.fit.identify import Search

_Free = Annotated[
    str,
    typer.Option(
        metavar="NAMES",
        help="Fields to estimate, separated by commas; NAME=VALUE sets the initial value, "
        "otherwise the recorded value.",
    ),
]
_From = Annotated[float | None, typer.Option("--from", help="Start in simulated time.", **SECONDS)]
_To = Annotated[float | None, typer.Option(help="End in simulated time.", **SECONDS)]
_Observe = Annotated[
    str | None,
    typer.Option(
        metavar="NAMES",
        help="Measured quantities of a recording, separated by commas. Default: dte_rms and "
        "power_loss, as far as they were recorded.",
    ),
]
_Noise = Annotated[
    list[str] | None,
    typer.Option(
        metavar="NAME=VALUE", help="Standard deviation of one reading, in SI. Repeatable."
    ),
]
_HoldOut = Annotated[
    str | None,
    typer.Option(
        metavar="FROM:TO",
        help="Another part in simulated seconds that is predicted with intervals and not fitted.",
    ),
]
_Scene = Annotated[
    str | None,
    typer.Option(metavar="SCENE", help="Scene of the gearbox, if FILE is a manoeuvre."),
]
_Report = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE",
        help="Write a report: .html, or .md and pictures.",
        callback=file_ending_in(".md", ".html"),
    ),
]


def fit(  # noqa: PLR0913 - an argument for each option
    file: FileArgument,
    free: _Free,
    from_: _From = None,
    to: _To = None,
    observe: _Observe = None,
    noise: _Noise = None,
    hold_out: _HoldOut = None,
    scene: _Scene = None,
    sensors: SensorsOption = None,
    scale: ScaleOption = None,
    report: _Report = None,
    namespace: NamespaceOption = None,
    json_: JsonOption = None,
) -> None:
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
    need("recording", "mcap", "rosbags")
    if report is not None:
        need("plots", "matplotlib")
    from ..recording.container.suffixes import is_table

    console, manoeuvre = console_beside(json_), is_table(file)
    if manoeuvre:
        need("analysis", "pyarrow")
    try:
        given, part = free_fields(free), Part(from_, to, held_out_span(hold_out))
        if manoeuvre:
            _refuse(f"{file} is a manoeuvre", {"--observe": observe, "--noise": noise})
            known = described_sensors(sensors, scale or [])
            found = fit_manoeuvre(console, file, scene, given, part, known)
        else:
            options = {"--scene": scene, "--sensors": sensors, "--scale": scale}
            _refuse(f"{file} is a recording", options)
            search = _search(given, observe, noise or [])
            found = fit_points(console, file, namespace, search, part)
    except (ValueError, ArithmeticError, OSError) as error:
        fail(error)
    write_json(found.figures, json_)
    if report is not None:
        from ..plots.fit_report import write_report

        with writing("--report", report):
            write_report(report, found.report())


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
