"""`planetary-twin spectrum`: spectral lines of the vibration of a mesh, by frequency or order."""

from __future__ import annotations

import inspect
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import chain, pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import typer

from ..terminal.arguments import JsonOption, SetOption, complete_recording, complete_scene
from ..terminal.console import busy
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, need, remark
from ..terminal.output_files import output_file
from ..terminal.settings import changed_scene, settings
from ..terminal.unit_options import HERTZ, SECONDS

if TYPE_CHECKING:
    from rich.console import Console

    from ..analysis.line_names import NamedLine
    from ..analysis.mesh_spectrum import MeshSpectrum
    from ..analysis.signals import Signal
    from ..recording.tables.speed_faults import SpeedColumn
    from ..scene import Scene

LINES = 12
CYCLES = 2  # in the record, from which on the amplitude of a line is exact to 2 %


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
    try:
        with busy("reading and analysing"):
            signal, found, subject = _analysed(asked)
        if asked.out is not None:
            _write(asked.out, found, _title(asked, subject, signal), _labels(asked, subject))
    except (ValueError, OSError) as error:
        fail(error)
    speed = _constant_speed if asked.order else _varying_speed
    remarks = (
        speed(asked, signal, found),
        _unused_speed(asked, signal, found, subject.unused_speed),
        _aliases(asked, signal, found),
    )
    doubts = subject.speed_jumps or _wrong_scale(asked, signal, found)
    for line in (*signal.remarks, *chain(*remarks), *doubts):
        remark(line)
    figures: dict[str, Any] = {"mesh": subject.mesh, "quantity": subject.quantity}
    figures |= _figures(asked, signal, found)
    _print(console_beside(asked.json_), figures, subject)
    write_json(figures, asked.json_)


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
    """Names of the analysed signal."""

    mesh: str | None
    """None for a sensor."""
    quantity: str
    unit: str
    unused_speed: SpeedColumn | None = None
    """Measured speed in a table that is not used."""
    speed_jumps: tuple[str, ...] = ()
    """Warnings about a measured speed that is used."""


def _read(asked: Options) -> tuple[Signal, _Subject]:
    from ..analysis.signals import QUANTITIES, read_signal

    if not asked.is_table:
        signal = read_signal(asked.file, asked.mesh, asked.quantity)
        return signal, _Subject(asked.mesh, asked.quantity, QUANTITIES[asked.quantity])
    from ..analysis.sensor import sensor_signal
    from ..recording.tables.sensor import read_sensor

    interval = asked.from_, asked.to
    sensor = read_sensor(
        asked.file, asked.column, asked.sample_rate, asked.speed, *interval, one_way=asked.order
    )
    scene = None if asked.scene is None else changed_scene(asked.scene, settings(asked.set_ or []))
    subject = _Subject(None, sensor.name, sensor.unit, sensor.unused_speed, sensor.speed_jumps)
    return sensor_signal(sensor, scene), subject


def _analysed(asked: Options) -> tuple[Signal, MeshSpectrum, _Subject]:
    from ..analysis.band import read_band
    from ..analysis.mesh_spectrum import frequency_spectrum_of, order_spectrum_of

    band = None if asked.band is None else read_band(asked.band, "" if asked.order else "Hz")
    signal, subject = _read(asked)
    if asked.from_ is None and asked.to is None:
        signal = _steady(asked.file, signal)
    else:
        signal = signal.within(asked.from_, asked.to)
    spectrum_of = order_spectrum_of if asked.order else frequency_spectrum_of
    scene = _scene(signal)
    found = spectrum_of(signal, None if scene is None else scene.gearset.teeth.sun)
    return signal, found if band is None else found.within(band), subject


def _title(asked: Options, subject: _Subject, signal: Signal) -> str:
    begin, end = signal.time[[0, -1]]
    return f"{asked.file.name}: {subject.mesh or subject.quantity}, {begin:.3f} to {end:.3f} s"


def _labels(asked: Options, subject: _Subject) -> tuple[str, str]:
    """Labels of the two axes."""
    axis = "order [cycles per turn]" if asked.order else "frequency [Hz]"
    return axis, f"amplitude of {subject.quantity} [{subject.unit}]"


def _steady(file: Path, signal: Signal) -> Signal:
    """The longest settled part at one operating point, or all of it if there is none."""
    from ..recording.container.suffixes import is_table
    from ..recording.runs.steadiness import steady_span

    if file.suffix == ".npz" or is_table(file):
        return signal.within(None, None)
    if span := steady_span(file):
        return signal.within(*span)
    whole = signal.within(None, None)
    line = f"{file}: no settled interval at one operating point was found; all of it is analysed"
    return replace(whole, remarks=(*whole.remarks, line))


def _scene(signal: Signal) -> Scene | None:
    """The scene of a signal, if it is known."""
    from ..scene import parse_scene

    return None if signal.scene_yaml is None else parse_scene(signal.scene_yaml)


def _varying_speed(_asked: Options, signal: Signal, found: MeshSpectrum) -> Iterator[str]:
    """A remark if a varying speed lowers lines over frequency."""
    from ..analysis.varying_speed import speed_remarks

    yield from speed_remarks(signal, found, LINES)


def _constant_speed(asked: Options, signal: Signal, _found: MeshSpectrum) -> Iterator[str]:
    """A remark if orders rest on a constant speed, which a table may contradict."""
    if asked.is_table and asked.speed is None:
        yield (
            f"--order: the speed is assumed to be constant, {signal.speed / math.tau:.6g} turns of "
            "the sun per second relative to the carrier; if it varies, give --speed COLUMN"
        )


def _unused_speed(
    asked: Options, signal: Signal, found: MeshSpectrum, column: SpeedColumn | None
) -> Iterator[str]:
    """A remark if a measured speed that is not used lowers lines."""
    from ..analysis.varying_speed import unused_speed_remarks

    if column is not None:
        hertz = abs(signal.speed) / math.tau if asked.order else 1.0
        yield from unused_speed_remarks(column, signal, found, hertz, LINES)


def _aliases(asked: Options, signal: Signal, found: MeshSpectrum) -> Iterator[str]:
    """A warning if the sample rate is too low for the signal.

    Not of a table: data loggers have an anti-aliasing filter, the waveform of a twin has none.
    """
    if asked.is_table:
        return
    from ..analysis.aliases import NEGLIGIBLE, alias_remark
    from ..simulation.natural_modes import natural_modes

    if found.alias_share <= NEGLIGIBLE:
        return
    highest = mesh = None
    scene = _scene(signal)
    if scene is not None:
        highest = float(natural_modes(scene).frequencies.max())
    if found.mesh is not None:
        mesh = found.mesh * signal.sample_rate / found.sample_rate
    yield alias_remark(signal.sample_rate, found.alias_share, highest, mesh)


def _wrong_scale(asked: Options, signal: Signal, found: MeshSpectrum) -> Iterator[str]:
    """A warning if the mesh harmonics of a table are elsewhere than those of the scene."""
    from ..analysis.wrong_scale import scale_remarks

    scene = _scene(signal)
    if asked.is_table and scene is not None:
        yield from scale_remarks(found, scene)


def _figures(asked: Options, signal: Signal, found: MeshSpectrum) -> dict[str, Any]:
    from ..analysis.line_names import LineNames

    axis = "order" if asked.order else "frequency_hz"
    names = LineNames(found, _scene(signal), filtered=asked.is_table)
    return {
        "from_s": float(signal.time[0]),
        "to_s": float(signal.time[-1]),
        "samples": len(signal.samples),
        "resolution": float(found.axis[1]),
        "mean": float(signal.samples.mean()),
        "unresolved_sidebands": names.unresolved(),
        "lines": [
            {
                axis: named.line.place,
                "amplitude": named.line.amplitude,
                "over_noise": named.over_noise,
                "mesh_orders": found.in_mesh_orders(named.line.place),
                "harmonic": named.harmonic,
                "alias_of_harmonic": named.alias,
                "sidebands": [band._asdict() for band in named.sidebands],
                "shafts": [shaft._asdict() for shaft in named.shafts],
                "overlap": _overlap(found, named),
                "name": named.text,
            }
            for named in names.named(LINES)
        ],
    }


def _overlap(found: MeshSpectrum, named: NamedLine) -> dict[str, Any] | None:
    """The closest line that overlaps a named one, with its distance on the axis."""
    if named.overlap is None or found.mesh is None:
        return None
    return named.overlap._asdict() | {"apart": found.mesh * named.overlap.apart}


def _print(console: Console, figures: dict[str, Any], subject: _Subject) -> None:
    from rich.table import Table

    table = Table(box=None, pad_edge=False)
    axis = "order" if figures["lines"] and "order" in figures["lines"][0] else "frequency_hz"
    headings = ("order" if axis == "order" else "frequency [Hz]", rf"amplitude \[{subject.unit}]")
    for heading in (*headings, "mesh orders"):
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("")
    for line in figures["lines"]:
        orders = line["mesh_orders"]
        table.add_row(
            f"{line[axis]:.3f}",
            f"{line['amplitude']:.4g}",
            "-" if orders is None else f"{orders:.4f}",
            line["name"],
        )
    console.print(table)
    unit = "orders" if axis == "order" else "Hz"
    sentences = (_uncertain(figures, axis), _overlapping(figures, unit), _unnamed(figures, unit))
    for line in chain(*sentences):
        console.print(line, highlight=False, soft_wrap=True)
    console.print(
        f"{subject.quantity}{f' of {subject.mesh}' if subject.mesh else ''}, "
        f"from {figures['from_s']:.4f} to {figures['to_s']:.4f} s, resolution "
        f"{figures['resolution']:.4g} {unit}, "
        f"mean {figures['mean']:.6g} {subject.unit}".removesuffix(" -"),
        highlight=False,
    )


def _uncertain(figures: dict[str, Any], axis: str) -> Iterator[str]:
    """Sentences on lines whose amplitude other lines, or the ends of the axis, change."""
    from ..analysis.distinct_lines import DISTINCT
    from ..analysis.sidebands import RESOLVED

    step = figures["resolution"]
    places = [line[axis] for line in figures["lines"]]
    slow = sum(place < CYCLES * step for place in places)
    if slow:
        yield (
            f"{slow} of these lines have fewer than {CYCLES:g} cycles in the record: their "
            "amplitudes are not exact, up to 9 % too low from 1.5 cycles, 41 % from one, more below"
        )
    clear = sorted(line[axis] for line in figures["lines"] if line["over_noise"] >= DISTINCT)
    near = sum(high - low < RESOLVED * step for low, high in pairwise(clear))
    if near:
        yield (
            f"{near} of these lines are less than {RESOLVED:g} times the resolution above another: "
            "they overlap, and their amplitudes are uncertain"
        )


def _overlapping(figures: dict[str, Any], unit: str) -> Iterator[str]:
    """A sentence if a line may hide another, with the length of record that separates them."""
    pairs = [line["overlap"] for line in figures["lines"] if line["overlap"] is not None]
    if pairs:
        closest = min(pairs, key=lambda pair: float(pair["apart"]))
        yield (
            f"{len(pairs)} of these lines may be the sum of two, with an uncertain amplitude: "
            f"{closest['named']} overlaps {closest['other']}, {closest['apart']:.4g} {unit} away; "
            f"separating them needs {_length(closest['apart'], unit)}"
        )


def _length(apart: float, unit: str) -> str:
    """Resolution that separates lines, and the length of signal that has it."""
    from ..analysis.sidebands import RESOLVED

    finest = apart / RESOLVED
    length = f"{1.0 / finest:.3g} {'s' if unit == 'Hz' else 'turns'}"
    return f"a resolution of {finest:.3g} {unit}, {length} of signal"


def _unnamed(figures: dict[str, Any], unit: str) -> Iterator[str]:
    """Sentences that say which lines have no name, and why."""
    from ..analysis.distinct_lines import DISTINCT

    weak = [line for line in figures["lines"] if line["over_noise"] < DISTINCT]
    if any(line["mesh_orders"] is not None for line in weak):
        yield (
            f"{len(weak)} of these lines have no name: they are less than {DISTINCT:g} times as "
            "high as the noise around them, or as the leakage of higher lines, or too low for "
            "interpolated samples"
        )
    for member, apart in figures["unresolved_sidebands"].items():
        yield (
            f"sidebands of the {member} are {apart:.4g} {unit} apart and not named: they need "
            f"{_length(apart, unit)}"
        )


def _write(out: Path, found: MeshSpectrum, title: str, labels: tuple[str, str]) -> None:
    if out.suffix == ".csv":
        import numpy as np

        table = np.column_stack((found.axis, found.amplitude))[found.in_band]
        np.savetxt(out, table, delimiter=",", header=",".join(labels), comments="")
        return
    from ..plots.spectrum import spectrum_plot
    from ..plots.style import save

    save(spectrum_plot(found, title, labels), str(out))
