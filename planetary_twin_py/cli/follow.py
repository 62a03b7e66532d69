"""`planetary-twin follow`: estimates the state of a gearbox from measurements."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..following.channels.sampled import DEVICES
from ..terminal.arguments import (
    JsonOption,
    SceneArgument,
    SetOption,
    file_option,
    picture_option,
    table_option,
)
from ..terminal.dataclass_options import take_options_of
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, need, one_line_errors, warn
from ..terminal.output_files import writing
from ..terminal.settings import scene_with
from ._damage_report import print_damage
from ._follow_inputs import ScaleOption, SensorsOption, described_sensors, read_measurements
from ._follow_report import print_state, state_figures

if TYPE_CHECKING:
    from ..following.follower import Follower
    from ..following.state import Following
    from ..scene import Scene
    from ..terminal.tables import TableConsole


@dataclass(frozen=True)
class Options:
    """Arguments and options of the command."""

    scene: SceneArgument
    from_: Annotated[
        Path,
        typer.Option(
            "--from",
            metavar="FILE",
            help="Readings: a .csv, .parquet or .mat table, or a recording (.mcap or its folder) "
            "with JointState, DynamicJointState, Temperature, EncoderBlock and SampledBlock "
            "messages.",
        ),
    ]
    sensors: SensorsOption = None
    scale: ScaleOption = None
    set_: SetOption = None
    baseline: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.npz",
            help="Compare teeth and vibration with this baseline of --save-baseline.",
        ),
    ] = None
    save_baseline: Annotated[
        Path | None, file_option("Write the learned baselines of teeth and vibration.", ".npz")
    ] = None
    durability: Annotated[
        Path | None,
        file_option(
            "Continue the damage of the gearbox in this file by the readings; the scene needs the "
            "section durability.",
            ".json",
        ),
    ] = None
    replace: Annotated[
        list[str] | None,
        typer.Option(
            metavar="PART",
            help="Of --durability: set the damage of a part that was replaced before these "
            "readings to 0, such as planet_2_bearing, or of a gear, such as planet_2. Repeatable.",
        ),
    ] = None
    out: Annotated[Path | None, table_option("Write the estimates of every second")] = None
    picture: Annotated[Path | None, picture_option("Draw teeth and friction level over time.")] = (
        None
    )
    json_: JsonOption = None


def follow(**given: Any) -> None:
    """Estimate the state of the gearbox of SCENE from measured torques, speeds and encoders.

    Prints friction level, drag, zero and gain of the torque sensors, inertia and compliance with
    95 % intervals, or the readings that are needed to determine them, then detected changes and
    teeth. Readings that contradict SCENE end the command and ask for units and signs. With
    --durability, damage of the parts and hours left at its mean rate follow.

    Example: planetary-twin follow paper --from readings.csv --encoders encoders.parquet
    """
    tables = {name: path for name in DEVICES if (path := given.pop(name)) is not None}
    asked = Options(**given)
    need("analysis", "pyarrow", "mcap", "rosbags")
    if asked.picture is not None:
        need("plots", "matplotlib")
    if asked.replace and asked.durability is None:
        fail("--replace: requires --durability")
    console = console_beside(asked.json_)
    with one_line_errors(ArithmeticError):
        follower, states, span = _followed(asked, tables, console)
    print_state(console, follower.scene.name, span, states[-1])
    figures = state_figures(states[-1])
    if follower.damage is not None and asked.durability is not None:
        with writing("--durability", asked.durability):
            follower.save_damage()
        print_damage(console, follower.damage.state)
        warn(follower.damage.state.warnings)
        figures["damage"] = follower.damage.state.figures()
    if asked.save_baseline is not None:
        with writing("--save-baseline", asked.save_baseline):
            follower.save_baseline(asked.save_baseline)
    if asked.out is not None:
        from ..following.notes import write_notes

        with writing("--out", asked.out):
            write_notes(asked.out, states)
    if asked.picture is not None:
        _draw(follower.scene, states, span[0], asked.picture)
    write_json(figures, asked.json_)


take_options_of(
    Options,
    follow,
    {
        device.name: Annotated[Path | None, typer.Option(metavar="FILE", help=device.table)]
        for device in DEVICES.values()
    },
)


def _followed(
    asked: Options, tables: Mapping[str, Path], console: TableConsole
) -> tuple[Follower, list[Following], tuple[float, float]]:
    """The follower, its states, and the first and the last stamp of the readings [s]."""
    from ..following.follower import Follower
    from ..following.measured.play_back import play_back

    scene = scene_with(asked.scene, asked.set_)
    known = described_sensors(asked.sensors, asked.scale or [])
    follower = Follower(scene, known, scale=known.scale, durability=asked.durability)
    for part in asked.replace or ():
        follower.replace_part(part)
    if asked.baseline is not None:
        follower.load_baseline(asked.baseline)
    measured = read_measurements(asked.from_, tables, known)
    with console.status("following"):
        states = list(play_back(follower, measured.readings, measured.samples))
    return follower, states, measured.span


def _draw(scene: Scene, states: Sequence[Following], first: float, picture: Path) -> None:
    """Draw the estimates over time; `first` is the stamp of the first reading [s]."""
    from ..following.train import followed_train
    from ..plots.follow import follow_diagram
    from ..plots.style import save

    with writing("--picture", picture):
        teeth = followed_train(scene).teeth
        save(follow_diagram(scene.name, teeth, states, first), str(picture))
