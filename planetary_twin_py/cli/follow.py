"""`planetary-twin follow`: estimates the state of a gearbox from measurements."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..terminal.arguments import (
    JsonOption,
    SceneArgument,
    SetOption,
    picture_option,
    table_option,
)
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, need, one_line_errors, warn
from ..terminal.output_files import file_ending_in, writing
from ..terminal.settings import scene_with
from ._damage_report import print_damage
from ._follow_inputs import (
    Files,
    ScaleOption,
    SensorsOption,
    described_sensors,
    encoder_format,
    read_measurements,
)
from ._follow_report import print_state, state_figures

if TYPE_CHECKING:
    from ..following.state import Following
    from ..scene import Scene

_Readings = Annotated[
    Path,
    typer.Option(
        "--from",
        metavar="FILE",
        help="Readings: a .csv, .parquet or .mat table, or a recording (.mcap or its folder) "
        "with JointState, DynamicJointState, Temperature, EncoderBlock and SampledBlock "
        "messages.",
    ),
]
_Encoders = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE",
        help="Samples of two encoders: a table with the columns sample (or time), "
        "input_counts and output_counts.",
    ),
]
_Vibration = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE",
        help="Samples of accelerometers: a table with the column time and one for each sensor; "
        "may be the table of --from.",
    ),
]
_Baseline = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE.npz",
        help="Compare teeth and vibration with this baseline of --save-baseline.",
    ),
]
_SaveBaseline = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE.npz",
        help="Write the learned baselines of teeth and vibration.",
        callback=file_ending_in(".npz"),
    ),
]
_Durability = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE.json",
        help="Continue the damage of the gearbox in this file by the readings; the scene needs "
        "the section durability.",
        callback=file_ending_in(".json"),
    ),
]
_Replace = Annotated[
    list[str] | None,
    typer.Option(
        metavar="PART",
        help="Of --durability: set the damage of a part that was replaced before these readings "
        "to 0, such as planet_2_bearing, or of a gear, such as planet_2. Repeatable.",
    ),
]
_Out = Annotated[Path | None, table_option("Write the estimates of every second")]
_Picture = Annotated[Path | None, picture_option("Draw teeth and friction level over time.")]


def follow(  # noqa: PLR0913 - an argument for each option
    scene: SceneArgument,
    from_: _Readings,
    encoders: _Encoders = None,
    vibration: _Vibration = None,
    sensors: SensorsOption = None,
    scale: ScaleOption = None,
    set_: SetOption = None,
    baseline: _Baseline = None,
    save_baseline: _SaveBaseline = None,
    durability: _Durability = None,
    replace: _Replace = None,
    out: _Out = None,
    picture: _Picture = None,
    json_: JsonOption = None,
) -> None:
    """Estimate the state of the gearbox of SCENE from measured torques, speeds and encoders.

    Prints friction level, drag, zero and gain of the torque sensors, inertia and compliance with
    95 % intervals, or the readings that are needed to determine them, then detected changes and
    teeth. Readings that contradict SCENE end the command and ask for units and signs. With
    --durability, damage of the parts and hours left at its mean rate follow.

    Example: planetary-twin follow paper --from readings.csv --encoders encoders.parquet
    """
    need("analysis", "pyarrow", "mcap", "rosbags")
    if picture is not None:
        need("plots", "matplotlib")
    from ..following.follower import Follower
    from ..following.measured.play_back import play_back

    if replace and durability is None:
        fail("--replace: requires --durability")
    console = console_beside(json_)
    files = Files(from_, encoders, vibration)
    with one_line_errors(ArithmeticError):
        loaded = scene_with(scene, set_)
        known = described_sensors(sensors, scale or [])
        follower = Follower(
            loaded, known, encoder_format(files, known), known.scale, durability=durability
        )
        for part in replace or ():
            follower.replace_part(part)
        if baseline is not None:
            follower.load_baseline(baseline)
        measured = read_measurements(files, known)
        with console.status("following"):
            states = list(play_back(follower, measured.readings, measured.samples))
    print_state(console, loaded.name, measured.span, states[-1])
    if follower.damage is not None and durability is not None:
        with writing("--durability", durability):
            follower.save_damage()
        print_damage(console, follower.damage.state)
        warn(follower.damage.state.warnings)
    if save_baseline is not None:
        with writing("--save-baseline", save_baseline):
            follower.save_baseline(save_baseline)
    if out is not None:
        from ..following.notes import write_notes

        with writing("--out", out):
            write_notes(out, states)
    if picture is not None:
        _draw(loaded, states, measured.span[0], picture)
    if json_ is not None:
        figures = state_figures(states[-1])
        if follower.damage is not None:
            figures["damage"] = follower.damage.state.figures()
        write_json(figures, json_)


def _draw(scene: Scene, states: Sequence[Following], first: float, picture: Path) -> None:
    """Draw the estimates over time; `first` is the stamp of the first reading [s]."""
    from ..following.train import followed_train
    from ..plots.follow import follow_diagram
    from ..plots.style import save

    with writing("--picture", picture):
        teeth = followed_train(scene).teeth
        save(follow_diagram(scene.name, teeth, states, first), str(picture))
