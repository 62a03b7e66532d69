"""Commands that need ROS, offered to the `planetary-twin` command line."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from planetary_twin_py.terminal.arguments import JsonOption, SceneArgument
from planetary_twin_py.terminal.dataclass_options import take_options_of
from planetary_twin_py.terminal.json_output import console_beside, write_json
from planetary_twin_py.terminal.messages import fail, need, remark
from planetary_twin_py.terminal.settings import changed_scene, settings
from planetary_twin_py.terminal.unit_options import SECONDS

from ..base.rate_factor import check_rate_factor
from ..process.signals import interrupt_on_signals

if TYPE_CHECKING:
    from .plant_session import PlantPlan

RECORDINGS = Path("recordings")
SHORTEST = 0.1  # [s] shortest run
LONGEST_PLAY = 86_400.0  # [s] of a plant


@dataclass(frozen=True)
class Options:
    """Arguments and options of the command."""

    scene: SceneArgument = "paper"
    duration: Annotated[
        float, typer.Option(help="Simulated time; inf: until Ctrl-C.", **SECONDS)
    ] = 12.0
    record: Annotated[
        str | None, typer.Option(metavar="NAME", help="Folder in recordings/; must be free.")
    ] = None
    set_: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="NAME=VALUE",
            help="Value at the start, in SI or with a unit: backlash=0.3um; repeatable.",
        ),
    ] = None
    rate_factor: Annotated[
        float, typer.Option(help="Simulated seconds per second; 0: as fast as possible.")
    ] = 1.0
    tolerance: Annotated[
        float, typer.Option(help="Relative error of a step; 0: the tightest that time allows.")
    ] = 0.0
    param: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME=VALUE",
            help="Parameter of the node simulation that is fixed while it runs: "
            "continuous_joints=true, publish_rate=200, command_timeout=0.3; repeatable.",
        ),
    ] = None
    durability: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.json",
            help="Continue the damage of the gearbox from this file, which is written each minute "
            "and at the end; the scene needs the section durability.",
        ),
    ] = None
    tour: Annotated[
        bool, typer.Option(help="Change the operating point during the run, as a demonstration.")
    ] = True
    plant: Annotated[
        str | None,
        typer.Option(metavar="SCENE", help="Simulate the sensors of this gearbox, and follow it."),
    ] = None
    hidden: Annotated[
        Path | None,
        typer.Option(metavar="FILE.yaml", help="Of --plant: duty, changes and sensors."),
    ] = None
    sensors: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.yaml", help="Of --plant: accuracy of the sensors, see `follow`."
        ),
    ] = None
    json_: JsonOption = None

    @property
    def of_simulation(self) -> bool:
        """Whether an option is given that only a simulation has."""
        given = self.set_ or self.param or self.tolerance or self.durability is not None
        return bool(given) or self.rate_factor != 1.0


def run(**given: Any) -> None:
    """
    Run a gearbox in real time on ROS 2, change its operating point, and record it.

    With --plant a plant with hidden changes and sensor errors takes its place, and a follower
    estimates its state; see the command `plant`.

    Example: planetary-twin run paper --duration 20 --record first --set backlash=0.3um
    """
    asked = Options(**given)
    need("ros", "mcap", "rosbags")
    if not asked.duration >= SHORTEST:
        fail(f"--duration = {asked.duration:g} s: must be at least {SHORTEST:g} s")
    interrupt_on_signals()
    if asked.plant is None and (asked.hidden is not None or asked.sensors is not None):
        fail("--hidden and --sensors: require --plant")
    if asked.plant is not None and asked.of_simulation:
        fail(
            "--plant: --set, --param, --rate-factor, --tolerance, --durability are options of "
            "a simulation"
        )
    try:
        if asked.plant is None:
            _run(asked)
        else:
            _follow_plant(asked, asked.plant)
    except KeyboardInterrupt:
        remark("interrupted before the recording started")
    except typer.Exit:  # a RuntimeError
        raise
    except ValueError as mistake:
        fail(mistake)
    except (RuntimeError, OSError) as failure:
        fail(failure, 1)


take_options_of(Options, run)


def _run(asked: Options) -> None:
    """Run a simulation."""
    # Imported here: ROS and the model take a second to load, and Ctrl-C must end that cleanly.
    from planetary_twin_py.run.tolerance import ladder_of

    from .node_settings import node_settings
    from .outcome import print_outcome
    from .session import Plan, run_session
    from .tour import tour_of

    # Refuse invalid options before any process starts.
    ladder_of(asked.tolerance)
    check_rate_factor(asked.rate_factor)
    scene, duration = asked.scene, asked.duration
    folder = _folder(asked.record, scene)
    params = list(asked.param or [])
    if asked.durability is not None:
        params.append(f"damage_file={asked.durability.absolute()}")
    options = {"rate_factor": asked.rate_factor, "tolerance": asked.tolerance}
    values = {**options, **_values(scene, asked.set_ or []), **node_settings(params)}
    plan = Plan(scene, duration, folder, values, tour_of(scene, duration) if asked.tour else [])
    console = console_beside(asked.json_)
    outcome = run_session(plan, console)
    print_outcome(console, outcome)
    write_json(outcome.figures(), asked.json_)
    if losses := outcome.losses():
        counts = ", ".join(f"{count} of {topic}" for topic, count in losses.items())
        raise RuntimeError(f"{outcome.files[0].parent}: messages are lost: {counts}")


def _follow_plant(asked: Options, scene: str) -> None:
    """Play a plant of a scene, and follow it."""
    from .followed import print_followed
    from .plant_session import run_plant_session

    console = console_beside(asked.json_)
    try:
        followed = run_plant_session(_plant_plan(asked, scene), console)
    except OSError as failure:
        raise ValueError(f"{failure.filename}: {failure.strerror}") from None
    print_followed(console, followed)
    write_json(followed.figures(), asked.json_)


def _plant_plan(asked: Options, scene: str) -> PlantPlan:
    """Return what to play, refused before any process starts if it is invalid."""
    import planetary_twin_py as pt
    from planetary_twin_py.following.sensors import read_sensors
    from planetary_twin_py.plant.hidden import read_hidden

    from .plant_session import PlantPlan

    duration, hidden, sensors = asked.duration, asked.hidden, asked.sensors
    if not duration <= LONGEST_PLAY:
        raise ValueError(f"--duration = {duration:g} s: must be at most {LONGEST_PLAY:g} s")
    loaded = pt.load_scene(scene)
    if hidden is not None and (line := read_hidden(hidden, loaded).late_changes(duration)):
        remark(f"warning: {line}")
    if sensors is not None:
        read_sensors(sensors)
    paths = ("" if path is None else str(path.absolute()) for path in (hidden, sensors))
    return PlantPlan(scene, duration, _folder(asked.record, scene), *paths)


def _folder(record: str | None, scene: str) -> Path:
    from planetary_twin_py.recording.ros2.bag import free_folder, named_folder

    if record is None:
        return free_folder(RECORDINGS, Path(scene).stem)
    try:
        folder = named_folder(RECORDINGS, record)
    except ValueError as refusal:
        raise ValueError(f"--record = {refusal}") from None
    if folder.exists():
        raise ValueError(f"--record = {record!r}: {folder} exists; choose a free name")
    return folder


def _values(scene: str, given: list[str]) -> dict[str, float]:
    """Return the settings in SI, checked against the scene."""
    import planetary_twin_py as pt

    values = settings(given)
    for name, value in values.items():
        if name not in pt.TUNABLES:
            known = ", ".join(pt.TUNABLES)
            raise ValueError(f"--set '{name}={value}': must be NAME=VALUE, with NAME of {known}")
    point = changed_scene(scene, values).operating_point
    return {name: getattr(point, name) for name in values}
