"""Commands that need ROS, offered to the `planetary-twin` command line."""

from __future__ import annotations

import json
import signal
import sys
from pathlib import Path
from types import FrameType
from typing import Annotated

import planetary_twin_py as pt
import typer
from planetary_twin_py.recording.bag import free_folder
from rich.console import Console

RECORDINGS = Path("recordings")


def run(
    scene: Annotated[str, typer.Argument(help="Packaged scene, or path of a YAML file.")] = "paper",
    duration: Annotated[float, typer.Option(help="Gearbox time [s].", min=0.1)] = 12.0,
    record: Annotated[
        str | None, typer.Option(metavar="NAME", help="Folder in recordings/; must be free.")
    ] = None,
    set_: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="NAME=VALUE", help="Parameter at start (SI); repeatable."),
    ] = None,
    rate_factor: Annotated[
        float, typer.Option(help="Gearbox seconds per second.", min=0.01, max=100.0)
    ] = 1.0,
    tour: Annotated[
        bool, typer.Option(help="Change the operating point on the way, to show what it does.")
    ] = True,
    json_: Annotated[
        str | None, typer.Option("--json", metavar="FILE", help="Write figures; - prints them.")
    ] = None,
) -> None:
    """Run a gearbox live on ROS 2, change it while it runs, and record it."""
    from .running.children import RunError
    from .running.outcome import print_outcome
    from .running.session import Plan, run_session
    from .running.tour import tour as stops_of

    # Standard output is the machine's where figures are printed there.
    console = Console(stderr=json_ == "-")
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, _interrupt)
    try:
        plan = Plan(
            scene=scene,
            duration=duration,
            folder=_folder(record, scene),
            rate_factor=rate_factor,
            values=_values(scene, set_ or []),
            stops=stops_of(scene, duration) if tour else [],
        )
        outcome = run_session(plan, console)
    except (RunError, ValueError, OSError) as reason:
        print(f"planetary-twin run: {reason}", file=sys.stderr)
        raise typer.Exit(1) from None
    except KeyboardInterrupt:
        print("interrupted before the recording began", file=sys.stderr)
        raise typer.Exit(0) from None
    print_outcome(console, outcome)
    if json_ is not None:
        text = json.dumps(outcome.figures(), indent=2)
        print(text) if json_ == "-" else Path(json_).write_text(text + "\n", encoding="utf-8")


def _folder(record: str | None, scene: str) -> Path:
    if record is None:
        return free_folder(RECORDINGS, Path(scene).stem)
    if not record or Path(record).name != record:
        raise ValueError(f"--record = {record!r}: must be a plain name; it lands in {RECORDINGS}/")
    if (RECORDINGS / record).exists():
        raise ValueError(f"--record = {record!r}: {RECORDINGS / record} exists; choose a free name")
    return RECORDINGS / record


def _values(scene: str, settings: list[str]) -> dict[str, float]:
    """The settings in SI, tried on the scene before any process starts."""
    values = {}
    for setting in settings:
        name, equals, value = setting.partition("=")
        if not equals or name not in pt.TUNABLES:
            raise ValueError(f"--set {setting!r}: must be NAME=VALUE, NAME of {', '.join(pt.TUNABLES)}")
        values[name] = value
    point = pt.load_scene(scene).replace(**values).operating_point
    return {name: getattr(point, name) for name in values}


def _interrupt(number: int, frame: FrameType | None) -> None:
    raise KeyboardInterrupt
