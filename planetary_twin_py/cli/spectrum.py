"""`planetary-twin spectrum`: spectral lines of the vibration of a mesh, by frequency or order."""

from __future__ import annotations

import inspect
import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import typer

from ..terminal.arguments import JsonOption, SetOption, complete_recording, complete_scene
from ..terminal.console import busy
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, need, one_line_errors, remark
from ..terminal.output_files import output_file
from ..terminal.settings import scene_with
from ..terminal.unit_options import HERTZ, SECONDS

if TYPE_CHECKING:
    from ..analysis.line_report import LineReport
    from ..analysis.signals import Signal
    from ..recording.tables.sensor import Sensor
    from ..recording.tables.speed_faults import SpeedColumn
    from ..terminal.tables import TableConsole


@dataclass(frozen=True)
class Options:
    """Arguments and options of the command."""

    file: Annotated[
        Path,
        typer.Argument(
            metavar="FILE",
            help="Recording, .npz file from `simulate --out`, or table of a sensor (.csv, "
            ".parquet, .mat).",
            autocompletion=complete_recording,
        ),
    ]
    order: Annotated[
        bool,
        typer.Option(
            "--order",
            help="Orders: cycles per turn of the sun relative to the carrier. Of a table with "
            "--speed and without --scene: per turn of that shaft.",
        ),
    ] = False
    mesh: Annotated[str, typer.Option(help="Name of the mesh.")] = "sun_planet_1"
    quantity: Annotated[str, typer.Option(help="Such as dte or mesh_force.")] = "dte"
    band: Annotated[
        str | None,
        typer.Option(
            metavar="LOW:HIGH", help="Range of the axis, in Hz, or in orders with --order."
        ),
    ] = None
    from_: Annotated[
        float | None, typer.Option("--from", help="Start in simulated time.", **SECONDS)
    ] = None
    to: Annotated[
        float | None,
        typer.Option(
            help="End in simulated time. Default without --from: of a recording, the longest "
            "settled interval at one operating point; of another file, all samples.",
            **SECONDS,
        ),
    ] = None
    out: Annotated[
        Path | None,
        typer.Option(help="Write the spectrum to a .png or .csv file.", callback=output_file),
    ] = None
    column: Annotated[
        str | None,
        typer.Option(
            help="Of a table: the column with the signal, if there are several. If the table "
            "states no unit, as of a MAT file: 'acceleration [g]'."
        ),
    ] = None
    speed: Annotated[
        str | None,
        typer.Option(
            help="Of a table: the column with the measured speed of the input shaft, for orders "
            "while the speed varies; in rad/s without a unit in its heading. A MAT file has no "
            "headings: --speed 'speed [rpm]' states the unit."
        ),
    ] = None
    sample_rate: Annotated[
        float | None,
        typer.Option(help="Of a table: samples per second, in place of a column time.", **HERTZ),
    ] = None
    scene: Annotated[
        str | None,
        typer.Option(
            help="Of a table: scene with the gears and the speed, to identify mesh harmonics.",
            autocompletion=complete_scene,
        ),
    ] = None
    set_: SetOption = None
    json_: JsonOption = None

    @property
    def is_table(self) -> bool:
        """Whether the file is a table of a sensor."""
        from ..recording.container.suffixes import is_table

        return is_table(self.file)


def spectrum(**given: Any) -> None:
    """List the largest lines in the spectrum of one mesh, and identify mesh harmonics.

    Also of a vibration in a table with columns such as `time` and `acceleration [m/s^2]`; --scene
    defines the gears, and --set the speed: `spectrum vibration.csv --scene paper --set
    input_speed=998rpm`. If the speed varies, --speed names its column. Lines 5 times as high as the
    noise around them are named: mesh harmonics, sidebands up to the third (or one for each planet),
    rotations of the members, and aliases.

    Example: planetary-twin spectrum recordings/NAME --band 400:600 --out spectrum.png
    """
    asked = Options(**given)
    _check(asked)
    with one_line_errors():
        with busy("reading and analysing"):
            subject = _analysed(asked)
        report = subject.report
        if asked.out is not None:
            _write(asked.out, subject)
    for line in _remarks(asked, subject):
        remark(line)
    _print(console_beside(asked.json_), subject)
    named = {"mesh": subject.mesh, "quantity": subject.quantity}
    write_json(named | report.figures(), asked.json_)


# Typer reads the options from the signature.
vars(spectrum)["__signature__"] = inspect.signature(Options, eval_str=True).replace(
    return_annotation=None
)


def _check(asked: Options) -> None:
    """End the command if the output suffix is unknown or a package is missing."""
    out = asked.out
    if out is not None and out.suffix not in (".png", ".csv"):
        fail(f"--out = {str(out)!r}: must end in .png or .csv")
    if out is not None and out.suffix == ".png":
        need("plots", "matplotlib")
    given = (asked.column, asked.speed, asked.sample_rate, asked.scene, asked.set_)
    if asked.is_table:
        need("analysis", "pyarrow")
        if (asked.mesh, asked.quantity) != (Options.mesh, Options.quantity):
            fail(f"{asked.file}: --mesh and --quantity are not for tables")
        if asked.order and asked.scene is None and asked.speed is None:
            fail("--order: needs --speed, or --scene, which defines a constant speed")
        if asked.set_ and asked.scene is None:
            fail("--set: needs --scene")
    elif any(each is not None for each in given):
        from ..recording.container.suffixes import TABLES

        options = "--column, --speed, --sample-rate, --scene and --set are for tables"
        fail(f"{asked.file}: {options}; {TABLES}")
    elif asked.file.suffix != ".npz":
        need("recording", "mcap", "rosbags")


class _Subject(NamedTuple):
    """The analysed signal and its names."""

    file: str
    report: LineReport
    mesh: str | None
    """None for a sensor."""
    quantity: str
    unit: str
    unused_speed: SpeedColumn | None
    """Measured speed in a table that is not used."""
    speed_jumps: tuple[str, ...]
    """Warnings about a measured speed that is used."""


def _analysed(asked: Options) -> _Subject:
    from ..analysis.band import read_band
    from ..analysis.line_report import LineReport
    from ..analysis.mesh_spectrum import frequency_spectrum_of, order_spectrum_of
    from ..analysis.signals import QUANTITIES, read_signal, settled
    from ..scene import parse_scene

    band = None if asked.band is None else read_band(asked.band, "" if asked.order else "Hz")
    sensor = None
    if asked.is_table:
        sensor, signal = _sensor(asked)
    else:
        signal = read_signal(asked.file, asked.mesh, asked.quantity)
    if asked.from_ is None and asked.to is None:
        signal = settled(asked.file, signal)
    else:
        signal = signal.within(asked.from_, asked.to)
    scene = None if signal.scene_yaml is None else parse_scene(signal.scene_yaml)
    spectrum_of = order_spectrum_of if asked.order else frequency_spectrum_of
    found = spectrum_of(signal, None if scene is None else scene.gearset.teeth.sun)
    found = found if band is None else found.within(band)
    report = LineReport(signal, found, scene, asked.order, filtered=asked.is_table)
    name = asked.file.name
    if sensor is None:
        return _Subject(
            name, report, asked.mesh, asked.quantity, QUANTITIES[asked.quantity], None, ()
        )
    return _Subject(
        name, report, None, sensor.name, sensor.unit, sensor.unused_speed, sensor.speed_jumps
    )


def _sensor(asked: Options) -> tuple[Sensor, Signal]:
    from ..analysis.sensor import sensor_signal
    from ..recording.tables.sensor import read_sensor

    interval = asked.from_, asked.to
    sensor = read_sensor(
        asked.file, asked.column, asked.sample_rate, asked.speed, *interval, one_way=asked.order
    )
    scene = None if asked.scene is None else scene_with(asked.scene, asked.set_)
    return sensor, sensor_signal(sensor, scene)


def _remarks(asked: Options, subject: _Subject) -> Iterator[str]:
    """What lowers, moves or hides lines."""
    from ..analysis.line_report import LINES
    from ..analysis.varying_speed import speed_remarks, unused_speed_remarks
    from ..analysis.wrong_scale import scale_remarks

    report = subject.report
    signal, found = report.signal, report.spectrum
    yield from signal.remarks
    if not asked.order:
        yield from speed_remarks(signal, found, LINES)
    elif asked.is_table and asked.speed is None:
        yield (
            f"--order: the speed is assumed to be constant, {signal.speed / math.tau:.6g} turns of "
            "the sun per second relative to the carrier; if it varies, give --speed COLUMN"
        )
    if subject.unused_speed is not None:
        hertz = abs(signal.speed) / math.tau if asked.order else 1.0
        yield from unused_speed_remarks(subject.unused_speed, signal, found, hertz, LINES)
    if not asked.is_table:  # data loggers have an anti-aliasing filter
        yield from report.aliases()
    elif subject.speed_jumps:
        yield from subject.speed_jumps
    elif report.scene is not None:
        yield from scale_remarks(found, report.scene)


def _print(console: TableConsole, subject: _Subject) -> None:
    from ..terminal.tables import table

    report, orders = subject.report, subject.report.spectrum.in_mesh_orders
    headings = (
        "order" if report.by_order else "frequency [Hz]",
        f"amplitude [{subject.unit}]",
        "mesh orders",
        "",
    )
    lines = [
        [
            f"{place:.3f}",
            f"{amplitude:.4g}",
            "-" if (order := orders(place)) is None else f"{order:.4f}",
            named.text,
        ]
        for named in report.lines
        for place, amplitude in [named.line]
    ]
    console.print(table(headings, lines, texts=("",), whole=True, framed=False))
    for line in report.sentences():
        console.print(line, soft_wrap=True)
    of_mesh = f" of {subject.mesh}" if subject.mesh else ""
    begin, end = report.signal.time[[0, -1]]
    console.print(
        f"{subject.quantity}{of_mesh}, from {begin:.4f} to {end:.4f} s, resolution "
        f"{report.resolution:.4g} {report.unit}, "
        f"mean {report.mean:.6g} {subject.unit}".removesuffix(" -")
    )


def _write(out: Path, subject: _Subject) -> None:
    report = subject.report
    axis = "order [cycles per turn]" if report.by_order else "frequency [Hz]"
    labels = axis, f"amplitude of {subject.quantity} [{subject.unit}]"
    if out.suffix == ".csv":
        import numpy as np

        found = report.spectrum
        table = np.column_stack((found.axis, found.amplitude))[found.in_band]
        np.savetxt(out, table, delimiter=",", header=",".join(labels), comments="")
        return
    from ..plots.spectrum import spectrum_plot
    from ..plots.style import save

    begin, end = report.signal.time[[0, -1]]
    title = f"{subject.file}: {subject.mesh or subject.quantity}, {begin:.3f} to {end:.3f} s"
    save(spectrum_plot(report.spectrum, title, labels), str(out))
