"""`planetary-twin follow`: estimates the state of a gearbox from readings."""

from __future__ import annotations

import math
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..terminal.arguments import JsonOption, SceneArgument, SetOption
from ..terminal.json_output import console_beside, put_figures
from ..terminal.messages import fail, need, note, remark
from ..terminal.output_files import TABLES, file_ending_in
from ..terminal.settings import changed_scene, settings

if TYPE_CHECKING:
    from rich.console import Console

    from ..following.follower import EncoderFormat, EncoderSamples, Follower, Following
    from ..following.measured_messages import Block
    from ..following.sensors import Sensors

EPOCH = 1e8  # [s] above this, stamps count from 1970


def follow(
    scene: SceneArgument,
    from_: Annotated[
        Path,
        typer.Option(
            "--from",
            metavar="FILE",
            help="Readings: a .csv or .parquet table, or a recording (.mcap or its folder) with "
            "JointState, DynamicJointState, Temperature, EncoderBlock and SampledBlock messages.",
        ),
    ],
    encoders: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Samples of two encoders: a table with the columns sample (or time), "
            "input_counts and output_counts.",
        ),
    ] = None,
    sensors: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.yaml",
            help="What is known of the sensors: noise, encoders, names of columns and joints.",
        ),
    ] = None,
    scale: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME=FACTOR", help="Factor on the readings of a channel. Repeatable."
        ),
    ] = None,
    set_: SetOption = None,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Write the estimates of every second to a .csv, .parquet or .npz table.",
            callback=file_ending_in(*TABLES),
        ),
    ] = None,
    json_: JsonOption = None,
) -> None:
    """Follow the gearbox of SCENE by measured torques, speeds and encoders.

    Prints friction level, drag, zero and gain of the torque sensors, inertia and compliance with
    95 % intervals, or what would tell them, then changes that were found and teeth. Readings that
    cannot be those of the gearbox end the command with the likely unit or sign.

    Example: planetary-twin follow paper --from readings.csv --encoders encoders.parquet
    """
    need("analysis", "pyarrow", "mcap", "rosbags")
    from ..following.follower import Follower
    from ..following.play_back import play_back
    from ..following.sensors import Sensors, read_sensors

    console = console_beside(json_)
    try:
        loaded = changed_scene(scene, settings(set_ or []))
        known = read_sensors(sensors) if sensors is not None else Sensors()
        factors = known.scale | _factors(scale or [])
        follower = Follower(loaded, known, _format(known, encoders), factors)
        readings = _readings(from_, known, factors)
        samples = _samples(encoders, follower.encoders)
        with console.status("following"):
            said = list(play_back(follower, readings, samples))
    except (ValueError, ArithmeticError) as error:
        fail(error)
    except OSError as error:
        fail(f"{error.filename}: {error.strerror}")
    _show(console, follower, said[-1])
    if out is not None:
        from ..following.notes import write_notes

        try:
            write_notes(out, said)
        except (ValueError, OSError) as error:
            fail(f"--out = {str(out)!r}: {error}")
    if json_ is not None:
        put_figures(_figures(said[-1]), json_)


def _format(sensors: Sensors, encoders: Path | None) -> EncoderFormat | None:
    from ..following.follower import EncoderFormat

    if encoders is None:
        return None
    known = sensors.encoders
    return EncoderFormat((known.input_counts, known.output_counts), 1.0 / known.rate)


def _factors(given: list[str]) -> dict[str, float]:
    found = {}
    for name, value in settings(given).items():
        try:
            found[name] = float(value)
        except ValueError:
            raise ValueError(f"--scale {name} = {value!r}: must be a number") from None
    return found


def _readings(path: Path, sensors: Sensors, factors: dict[str, float]) -> list[Block]:
    if path.suffix in (".csv", ".parquet"):
        from ..following.measured_tables import read_readings

        found = read_readings(path, sensors.columns)
        if found.ignored:
            note(f"columns that are not used: {', '.join(found.ignored)}")
        return [found.readings]
    from ..following.measured_recording import read_recording

    damaged: list[str] = []
    found_in = read_recording(path, sensors.joints, factors, damaged)
    for line in damaged:
        remark(f"warning: {line}")
    return found_in


def _samples(path: Path | None, shape: EncoderFormat | None) -> EncoderSamples | None:
    from ..following.measured_tables import read_encoders

    return None if path is None or shape is None else read_encoders(path, shape.period)


def _show(console: Console, follower: Follower, said: Following) -> None:
    from rich.table import Table

    table = Table(title=f"{follower.scene.name}, {_instant(said.time)}")
    for heading in ("quantity", "estimate", "95 % interval", "unit", "status", "what would tell"):
        table.add_column(heading, justify="left" if heading == "what would tell" else "right")
    for one in said.estimates:
        shown = one.status in ("ESTIMATED", "STALE")
        value = f"{one.value:.4g}" if shown else "-"
        span = f"{one.low:.4g} to {one.high:.4g}" if shown else "-"
        status = {"NOT_IDENTIFIABLE": "NOT IDENTIFIABLE"}.get(one.status, one.status)
        table.add_row(one.name, value, span, one.unit or "-", status, one.remedy)
    console.print(table)
    for line in _in_words(said):
        console.print(line, highlight=False, markup=False, soft_wrap=True)
    for line in said.remarks:
        remark(f"warning: {line}")


def _instant(time: float) -> str:
    """A stamp in words: in UTC, if it counts from 1970."""
    if not time > EPOCH:
        return f"{time:.1f} s"
    return datetime.fromtimestamp(time, UTC).strftime("%Y-%m-%d %H:%M:%S.%f")[:-5]


def _in_words(said: Following) -> Iterator[str]:
    """Events and teeth, a line each."""
    if not said.events:
        yield "no change found"
    for event in said.events:
        causes = f"; {' or '.join(event.causes)}" if event.causes else ""
        since = f"since {_instant(event.since)}, found at {_instant(event.found)}"
        yield f"{event.what}: {event.evidence}; {since}{causes}"
    for tooth in said.teeth:
        loss = tooth.loss
        yield (
            f"{tooth.gear} tooth {tooth.tooth}: {' or '.join(tooth.kinds)}, as a crack "
            f"{100 * loss.low:.2g} to {100 * loss.high:.2g} % of stiffness lost, z = {tooth.z:.1f}"
        )


def _figures(said: Following) -> dict[str, Any]:
    return {
        "time": _finite(said.time),
        "estimates": {
            one.name: {key: _finite(value) for key, value in one._asdict().items() if key != "name"}
            for one in said.estimates
        },
        "events": [
            {
                "what": event.what,
                "since": event.since,
                "found": event.found,
                "size": {key: _finite(value) for key, value in event.size._asdict().items()},
                "causes": event.causes,
                "evidence": event.evidence,
            }
            for event in said.events
        ],
        "teeth": [
            {
                "gear": tooth.gear,
                "tooth": tooth.tooth,
                "stiffness_loss": tooth.loss.value,
                "low": tooth.loss.low,
                "high": tooth.loss.high,
                "z": tooth.z,
                "kinds": tooth.kinds,
                "candidates": tooth.candidates,
            }
            for tooth in said.teeth
        ],
        "counters": said.counters,
        "remarks": said.remarks,
    }


def _finite(value: Any) -> Any:
    """`value`, or None in place of NaN, which JSON lacks."""
    return None if isinstance(value, float) and not math.isfinite(value) else value
