"""`planetary-twin spectrum`: spectral lines of the vibration of a mesh, by frequency or order."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import typer

from ..terminal.arguments import JsonOption
from ..terminal.console import busy
from ..terminal.dataclass_options import take_options_of
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, need, one_line_errors, remark
from ..terminal.output_files import output_file
from ._signal_file import SignalFile

if TYPE_CHECKING:
    from ..analysis.line_report import LineReport
    from ..terminal.tables import TableConsole
    from ._signal_file import Selected


@dataclass(frozen=True)
class Options(SignalFile):
    """Arguments and options of the command."""

    order: Annotated[
        bool,
        typer.Option(
            "--order",
            help="Orders: cycles per turn of the sun relative to the carrier. Of a table with "
            "--speed and without --scene: per turn of that shaft.",
        ),
    ] = False
    band: Annotated[
        str | None,
        typer.Option(
            metavar="LOW:HIGH", help="Range of the axis, in Hz, or in orders with --order."
        ),
    ] = None
    envelope: Annotated[
        str | None,
        typer.Option(
            metavar="LOW:HIGH",
            help="Spectrum of the squared envelope of this band, in Hz, such as that of a "
            "resonance which impacts excite.",
        ),
    ] = None
    out: Annotated[
        Path | None,
        typer.Option(help="Write the spectrum to a .png or .csv file.", callback=output_file),
    ] = None
    json_: JsonOption = None


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
    named = {"mesh": subject.selected.mesh, "quantity": subject.selected.quantity}
    write_json(named | report.figures(), asked.json_)


take_options_of(Options, spectrum)


def _check(asked: Options) -> None:
    """End the command if the output suffix is unknown or a package is missing."""
    out = asked.out
    if out is not None and out.suffix not in (".png", ".csv"):
        fail(f"--out = {str(out)!r}: must end in .png or .csv")
    if out is not None and out.suffix == ".png":
        need("plots", "matplotlib")
    asked.check()
    if asked.is_table and asked.order and asked.scene is None and asked.speed is None:
        fail("--order: needs --speed, or --scene, which defines a constant speed")


class _Subject(NamedTuple):
    """The analysed signal and its names."""

    file: str
    report: LineReport
    selected: Selected


def _analysed(asked: Options) -> _Subject:
    from ..analysis.band import read_band
    from ..analysis.line_report import LineReport
    from ..analysis.mesh_spectrum import frequency_spectrum_of, order_spectrum_of
    from ..analysis.signals import squared_envelope

    band = None if asked.band is None else read_band(asked.band, "" if asked.order else "Hz")
    selected = asked.read(one_way=asked.order)
    signal, scene = selected.signal, selected.scene
    if asked.order and asked.sensor is not None and scene is None:
        raise ValueError(f"{asked.file}: --order: needs --scene, which defines a constant speed")
    if asked.envelope is not None:
        signal = squared_envelope(signal, read_band(asked.envelope, "Hz", "envelope"))
    spectrum_of = order_spectrum_of if asked.order else frequency_spectrum_of
    found = spectrum_of(signal, None if scene is None else scene.gearset.teeth.sun)
    found = found if band is None else found.within(band)
    report = LineReport(signal, found, scene, asked.order, filtered=selected.mesh is None)
    if asked.envelope is not None:
        name = f"squared envelope of {selected.quantity}"
        selected = selected._replace(quantity=name, unit=f"({selected.unit})^2")
    return _Subject(asked.file.name, report, selected)


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
    else:
        yield from subject.selected.assumed_speed
    sensor = subject.selected.sensor
    if sensor is not None and sensor.unused_speed is not None:
        hertz = abs(signal.speed) / math.tau if asked.order else 1.0
        yield from unused_speed_remarks(sensor.unused_speed, signal, found, hertz, LINES)
    if asked.envelope is not None:
        yield from subject.selected.aliases()
    elif subject.selected.mesh is not None:  # sensors have an anti-aliasing filter
        yield from report.aliases()
    if sensor is None:
        return
    if sensor.speed_jumps:
        yield from sensor.speed_jumps
    elif report.scene is not None and asked.envelope is None:
        yield from scale_remarks(found, report.scene)


def _print(console: TableConsole, subject: _Subject) -> None:
    from ..terminal.tables import table

    report, orders = subject.report, subject.report.spectrum.in_mesh_orders
    selected = subject.selected
    headings = (
        "order" if report.by_order else "frequency [Hz]",
        f"amplitude [{selected.unit}]",
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
    of_mesh = f" of {selected.mesh}" if selected.mesh else ""
    begin, end = report.signal.time[[0, -1]]
    console.print(
        f"{selected.quantity}{of_mesh}, from {begin:.4f} to {end:.4f} s, resolution "
        f"{report.resolution:.4g} {report.unit}, "
        f"mean {report.mean:.6g} {selected.unit}".removesuffix(" -")
    )


def _write(out: Path, subject: _Subject) -> None:
    report = subject.report
    axis = "order [cycles per turn]" if report.by_order else "frequency [Hz]"
    selected = subject.selected
    labels = axis, f"amplitude of {selected.quantity} [{selected.unit}]"
    if out.suffix == ".csv":
        import numpy as np

        found = report.spectrum
        table = np.column_stack((found.axis, found.amplitude))[found.in_band]
        np.savetxt(out, table, delimiter=",", header=",".join(labels), comments="")
        return
    from ..plots.spectrum import spectrum_plot
    from ..plots.style import save

    begin, end = report.signal.time[[0, -1]]
    title = f"{subject.file}: {selected.mesh or selected.quantity}, {begin:.3f} to {end:.3f} s"
    save(spectrum_plot(report.spectrum, title, labels), str(out))
