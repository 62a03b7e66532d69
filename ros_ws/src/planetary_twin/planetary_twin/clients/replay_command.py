"""`planetary-twin replay`; options are named as in `ros2 bag play` if it has them."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass
from typing import Annotated, Any

import typer

from planetary_twin_py.terminal.arguments import FileArgument
from planetary_twin_py.terminal.dataclass_options import take_options_of
from planetary_twin_py.terminal.messages import fail, need

from ..process.signals import interrupt_on_signals


@dataclass(frozen=True)
class Options:
    """Options of the command: the node's parameters, and renamed topics."""

    file: FileArgument
    rate_factor: Annotated[
        float,
        typer.Option(
            "--rate-factor", "--rate", "-r", help="Recorded seconds per second; 0: no limit."
        ),
    ] = 1.0
    start: Annotated[
        float,
        typer.Option("--start", "--start-offset", help="Recorded time at the start [s].", min=0.0),
    ] = 0.0
    duration: Annotated[
        float | None,
        typer.Option(
            "--duration",
            "--playback-duration",
            help="Recorded time to play [s]; without: to the end.",
            min=1e-9,
        ),
    ] = None
    loop: Annotated[bool, typer.Option("--loop", "-l", help="Repeat until Ctrl-C.")] = False
    start_paused: Annotated[bool, typer.Option("--start-paused", "-p", help="Start paused.")] = (
        False
    )
    clock: Annotated[
        float,
        typer.Option(metavar="HZ", help="/clock messages per recorded second; 0: none.", min=0.0),
    ] = 0.0
    topics: Annotated[
        list[str] | None, typer.Option(metavar="NAME", help="Recorded topic to play; repeatable.")
    ] = None
    remap: Annotated[
        list[str] | None,
        typer.Option("--remap", "-m", metavar="OLD:=NEW", help="Rename a topic; repeatable."),
    ] = None
    namespace: Annotated[
        str, typer.Option(metavar="NS", help="Replaces the recorded namespace.")
    ] = ""


def replay(**given: Any) -> None:
    """
    Publish the messages of a recording, byte for byte and in recorded time.

    Services replay/pause, replay/step and replay/seek and the parameter rate_factor control it.

    Example: planetary-twin replay recordings/NAME --rate 0.5 --loop
    """
    need("ros", "mcap", "rosbags")
    interrupt_on_signals()
    remappings = given.pop("remap") or []
    for rule in remappings:
        if ":=" not in rule:
            fail(f"--remap {rule}: must be OLD:=NEW")
    parameters = given | {
        "file": str(given["file"]),
        "duration": given["duration"] or 0.0,
        "topics": given["topics"] or [""],
    }
    code = 0
    with contextlib.suppress(KeyboardInterrupt):
        from .replay_progress import replay_shown

        code = replay_shown(parameters, remappings)
    raise typer.Exit(code)


take_options_of(Options, replay)
