"""`planetary-twin spectrum`: spectral lines of the vibration of a mesh, by frequency or order."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple, Self

import typer

from ..terminal.arguments import JsonOption, complete_recording
from ..terminal.console import busy
from ..terminal.dataclass_options import take_options_of
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, need, one_line_errors, remark
from ..terminal.output_files import output_file
from ._signal_file import FILE_HELP, OF_SCENE, SignalOptions
from ._table_options import OF_TABLES

if TYPE_CHECKING:
    from ..analysis.lines.line_report import LineReport
    from ..terminal.tables import TableConsole
    from ._signal_file import Selected


@dataclass(frozen=True)
class Options(SignalOptions):
    """Arguments and options of the command."""

    files: Annotated[
        list[Path],
        typer.Argument(
            metavar="FILE[:COLUMN]",
            help=f"{FILE_HELP} Several are compared, or averaged with --average; of tables, "
            "FILE:COLUMN replaces --column.",
            autocompletion=complete_recording,
        ),
    ] = field(kw_only=True)
    average: Annotated[
        bool,
        typer.Option("--average", help="Average the spectra of several files, by power."),
    ] = False
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

    @property
    def signals(self) -> list[tuple[Path, Self]]:
        """Each file with its column, if it names one, and the options that are for it."""
        found = [self._with_column(file) for file in self.files]
        if len({own.is_table(file) for file, own in found}) == 1:
            return found
        return [(file, own._of_kind(own.is_table(file))) for file, own in found]

    def _with_column(self, given: Path) -> tuple[Path, Self]:
        from ..recording.tables.source import source_of

        file, column = source_of(str(given), given)
        return file, self if file == given else replace(self, column=column)

    def _of_kind(self, is_table: bool) -> Self:
        """Only options for measured samples, or for those of a twin."""
        default = SignalOptions()
        other = ("mesh", "quantity", "sensor") if is_table else (*OF_TABLES, *OF_SCENE)
        return replace(self, **{name: getattr(default, name) for name in other})


def spectrum(**given: Any) -> None:
    """List the largest lines in the spectrum of one mesh, and identify mesh harmonics.

    Also of a measured vibration, such as a table with the columns `time` and `acceleration
    [m/s^2]`; --scene defines the gears, and --set the speed: `spectrum vibration.csv --scene paper
    --set input_speed=998rpm`. If the speed varies, --speed names its column. Lines 5 times as high
    as the noise around them are named: mesh harmonics, sidebands up to the third (or one for each
    planet), rotations of the members, and aliases. The first three mesh harmonics, or their
    aliases, are named where noise alone would be so high in one of 1000 cases.

    Example: planetary-twin spectrum recordings/NAME --band 400:600 --out spectrum.png
    """
    asked = Options(**given)
    _check(asked)
    with one_line_errors():
        with busy("reading and analysing"):
            subjects = _analysed(asked)
        if asked.out is not None:
            _write(asked.out, subjects)
    for subject in subjects:
        for line in _remarks(asked, subject):
            remark(line)
        _print(console_beside(asked.json_), subject)
    figures = [subject.figures() for subject in subjects]
    one = {name: value for name, value in figures[0].items() if name != "file"}
    write_json(one if len(figures) == 1 else {"spectra": figures}, asked.json_)


take_options_of(Options, spectrum)


def _check(asked: Options) -> None:
    """End the command if the output suffix is unknown or a package is missing."""
    out = asked.out
    if out is not None and out.suffix not in (".png", ".csv"):
        fail(f"--out = {str(out)!r}: must end in .png or .csv")
    if out is not None and out.suffix == ".png":
        need("plots", "matplotlib")
    if out is not None and out.suffix == ".csv" and len(asked.files) > 1 and not asked.average:
        fail(f"--out = {str(out)!r}: several files are drawn as .png")
    for file, own in asked.signals:
        own.check(file)
        if own.is_table(file) and asked.order and not (asked.scene or asked.has_speed):
            fail("--order: needs --speed, or --scene, which defines a constant speed")


class _Subject(NamedTuple):
    """The analysed signal and its names."""

    file: str
    report: LineReport
    selected: Selected
    remarks: tuple[str, ...] = ()

    def figures(self) -> dict[str, Any]:
        """The lines, with the name of the signal, for JSON."""
        named = {"file": self.file, "mesh": self.selected.mesh, "quantity": self.selected.quantity}
        return named | self.report.figures()


def _analysed(asked: Options) -> list[_Subject]:
    files = [file for file, _ in asked.signals]
    every = [own.read(file, one_way=asked.order) for file, own in asked.signals]
    for file, selected in zip(files, every, strict=True):
        known = selected.scene is not None or asked.has_speed
        if asked.order and selected.mesh is None and not known:
            raise ValueError(f"{file}: --order: needs --scene, which defines a constant speed")
    if asked.average:
        return [_averaged(asked, every)]
    return [
        _subject(asked, given.name, [selected])
        for given, selected in zip(asked.files, every, strict=True)
    ]


def _averaged(asked: Options, every: list[Selected]) -> _Subject:
    """The average of all files, which must have the same quantity, unit and gears."""
    first = every[0]
    for file, other in zip(asked.files, every, strict=True):
        names = ("quantity", "unit", "mesh")
        for name in names:
            mine, its = getattr(first, name), getattr(other, name)
            if name != "quantity" and mine != its:
                raise ValueError(f"{file}: average: {name} = {its!r}: must be {mine!r} as before")
    return _subject(asked, f"average of {len(every)} files", every)


def _subject(asked: Options, name: str, every: list[Selected]) -> _Subject:
    from ..analysis.lines.averaged_spectrum import averaged_spectrum, spread_of_mesh
    from ..analysis.lines.line_report import LineReport
    from ..analysis.signals.signal import squared_envelope
    from ..analysis.spectra.band import read_band

    band = None if asked.band is None else read_band(asked.band, "" if asked.order else "Hz")
    selected, scene = every[0], every[0].scene
    signals = [one.signal for one in every]
    if asked.envelope is not None:
        around = read_band(asked.envelope, "Hz", "envelope")
        signals = [squared_envelope(one, around) for one in signals]
    teeth = None if scene is None else scene.gearset.teeth.sun
    found = averaged_spectrum(signals, teeth, asked.order)
    spread = None
    if teeth is not None and not asked.order and len(signals) > 1:
        spread = spread_of_mesh(signals, float(found.axis[1]), teeth)
    found = found if band is None else found.within(band)
    report = LineReport(signals[0], found, scene, asked.order, filtered=selected.mesh is None)
    if asked.envelope is not None:
        quantity = f"squared envelope of {selected.quantity}"
        selected = selected._replace(quantity=quantity, unit=f"({selected.unit})^2")
    further = tuple(line for one in every[1:] for line in one.signal.remarks)
    further = tuple(dict.fromkeys((*further, *filter(None, [spread]))))
    return _Subject(name, report, selected, further)


def _remarks(asked: Options, subject: _Subject) -> Iterator[str]:
    """What lowers, moves or hides lines."""
    from ..analysis.lines.line_report import LINES
    from ..analysis.lines.varying_speed import speed_remarks, unused_speed_remarks
    from ..analysis.lines.wrong_scale import scale_remarks

    report = subject.report
    signal, found = report.signal, report.spectrum
    yield from signal.remarks
    yield from subject.remarks
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


def _write(out: Path, subjects: list[_Subject]) -> None:
    from ..plots.style import save

    first = subjects[0].report
    axis = "order [cycles per turn]" if first.by_order else "frequency [Hz]"
    ordinates = [f"amplitude of {one.selected.quantity} [{one.selected.unit}]" for one in subjects]
    if out.suffix == ".csv":
        import numpy as np

        found = first.spectrum
        table = np.column_stack((found.axis, found.amplitude))[found.in_band]
        np.savetxt(out, table, delimiter=",", header=f"{axis},{ordinates[0]}", comments="")
        return
    titles = []
    for one in subjects:
        begin, end = one.report.signal.time[[0, -1]]
        named = one.selected.mesh or one.selected.quantity
        titles.append(f"{one.file}: {named}, {begin:.3f} to {end:.3f} s")
    if len(subjects) == 1:
        from ..plots.spectrum import spectrum_plot

        save(spectrum_plot(first.spectrum, titles[0], (axis, ordinates[0])), str(out))
        return
    from ..plots.compared_spectra import Compared, compared_spectra

    panels = [
        Compared(one.report.spectrum, title, ordinate, one.report.lines)
        for one, title, ordinate in zip(subjects, titles, ordinates, strict=True)
    ]
    save(compared_spectra(panels, axis), str(out))
