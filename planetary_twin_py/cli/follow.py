"""`planetary-twin follow`: estimates the state of a gearbox from measurements."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..terminal.arguments import JsonOption, SceneArgument, SetOption
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, need, note, remark
from ..terminal.output_files import PICTURES, TABLES, file_ending_in
from ..terminal.settings import changed_scene, settings
from ._follow_report import print_state, state_figures

if TYPE_CHECKING:
    import numpy as np

    from ..following.follower import EncoderFormat, EncoderSamples
    from ..following.measured_messages import Block
    from ..following.sensors import Sensors
    from ..following.vibration import VibrationSamples


def follow(  # noqa: PLR0913 - an argument for each option
    scene: SceneArgument,
    from_: Annotated[
        Path,
        typer.Option(
            "--from",
            metavar="FILE",
            help="Readings: a .csv, .parquet or .mat table, or a recording (.mcap or its folder) "
            "with JointState, DynamicJointState, Temperature, EncoderBlock and SampledBlock "
            "messages.",
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
    vibration: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Samples of accelerometers: a table with the column time and one for each sensor; "
            "may be the table of --from.",
        ),
    ] = None,
    sensors: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.yaml",
            help="Sensors: noise, uncertainty, encoders, names of columns and joints.",
        ),
    ] = None,
    scale: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME=FACTOR", help="Factor on the readings of a channel. Repeatable."
        ),
    ] = None,
    set_: SetOption = None,
    baseline: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.npz",
            help="Compare teeth and vibration with this baseline of --save-baseline.",
        ),
    ] = None,
    save_baseline: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.npz",
            help="Write the learned baselines of teeth and vibration.",
            callback=file_ending_in(".npz"),
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Write the estimates of every second to a .csv, .parquet or .npz table.",
            callback=file_ending_in(*TABLES),
        ),
    ] = None,
    picture: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.png",
            help="Draw teeth and friction level over time.",
            callback=file_ending_in(*PICTURES),
        ),
    ] = None,
    json_: JsonOption = None,
) -> None:
    """Estimate the state of the gearbox of SCENE from measured torques, speeds and encoders.

    Prints friction level, drag, zero and gain of the torque sensors, inertia and compliance with
    95 % intervals, or the readings that are needed to determine them, then detected changes and
    teeth. Readings that contradict SCENE end the command with the likely unit or sign.

    Example: planetary-twin follow paper --from readings.csv --encoders encoders.parquet
    """
    need("analysis", "pyarrow", "mcap", "rosbags")
    if picture is not None:
        need("plots", "matplotlib")
    from ..following.follower import Follower
    from ..following.play_back import play_back
    from ..following.sensors import Sensors, read_sensors

    console = console_beside(json_)
    try:
        loaded = changed_scene(scene, settings(set_ or []))
        known = read_sensors(sensors) if sensors is not None else Sensors()
        factors = known.scale | _factors(scale or [])
        follower = Follower(loaded, known, _format(known, encoders), factors)
        if baseline is not None:
            follower.load_baseline(baseline)
        readings, begin, unused = _readings(from_, known, factors)
        samples = _samples(encoders, vibration, known, begin)
        _note_unused(unused, samples if from_ in (encoders, vibration) else ())
        with console.status("following"):
            states = list(play_back(follower, readings, samples))
    except (ValueError, ArithmeticError, OSError) as error:
        fail(error)
    print_state(console, loaded.name, states[-1])
    if save_baseline is not None:
        try:
            follower.save_baseline(save_baseline)
        except (ValueError, OSError) as error:
            fail(f"--save-baseline = {str(save_baseline)!r}: {error}")
    if out is not None:
        from ..following.notes import write_notes

        try:
            write_notes(out, states)
        except (ValueError, OSError) as error:
            fail(f"--out = {str(out)!r}: {error}")
    if picture is not None:
        from ..following.train import followed_train
        from ..plots.follow import follow_diagram
        from ..plots.style import save

        try:
            save(follow_diagram(loaded.name, followed_train(loaded).teeth, states), str(picture))
        except (ValueError, OSError) as error:
            fail(f"--picture = {str(picture)!r}: {error}")
    if json_ is not None:
        write_json(state_figures(states[-1]), json_)


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


def _readings(
    path: Path, sensors: Sensors, factors: dict[str, float]
) -> tuple[list[Block], np.datetime64 | None, tuple[str, ...]]:
    """Blocks of readings, the date of second 0 of their stamps, and columns that are not used."""
    from ..recording.tables.suffixes import SUFFIXES

    if path.suffix in SUFFIXES:
        from ..following.measured_tables import read_readings

        found = read_readings(path, sensors.columns)
        return [found.readings], found.begin, found.ignored
    from ..following.measured_recording import BEGIN, read_recording

    damaged: list[str] = []
    found_in = read_recording(path, sensors.joints, factors, damaged)
    for line in damaged:
        remark(f"warning: {line}")
    return found_in, BEGIN, ()


def _samples(
    encoders: Path | None,
    vibration: Path | None,
    sensors: Sensors,
    begin: np.datetime64 | None,
) -> list[EncoderSamples | VibrationSamples]:
    """Samples of other files than the readings."""
    from ..following.measured_tables import read_encoders, read_vibration

    found: list[EncoderSamples | VibrationSamples] = []
    if encoders is not None:
        found.append(read_encoders(encoders, 1.0 / sensors.encoders.rate, begin))
    if vibration is not None:
        found.append(read_vibration(vibration, sensors.columns, begin))
    return found


def _note_unused(columns: tuple[str, ...], samples: Sequence[object]) -> None:
    """Name the columns that neither the readings nor the samples use."""
    from ..following.measured_tables import COUNTS, SAMPLE

    used = {name for one in samples for name in getattr(one, "names", (SAMPLE, *COUNTS))}
    left = [name for name in columns if name not in used]
    if left:
        note(f"columns that are not used: {', '.join(left)}")
