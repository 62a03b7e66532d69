"""`planetary-twin resimulate`: repeats a recorded run with other values from a given time."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..terminal.arguments import FileArgument, NamespaceOption, SetOption
from ..terminal.console import make_console, progress_of
from ..terminal.messages import need, one_line_errors, remark
from ..terminal.output_files import check_recording
from ..terminal.settings import say_units, settings
from ..terminal.unit_options import SECONDS


def resimulate(
    file: FileArgument,
    set_: SetOption = None,
    from_: Annotated[
        float,
        typer.Option("--from", help="Simulated time from which the new values apply.", **SECONDS),
    ] = 0.0,
    commands: Annotated[
        Path | None,
        typer.Option(
            help="Commands at the ports, in place of the recorded ones of the same shafts: a table "
            "(.csv, .parquet) of time, input_torque, output_speed, ..., or another recording."
        ),
    ] = None,
    duration: Annotated[
        float | None,
        typer.Option(help="Length of the new run.", show_default="as recorded", **SECONDS),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(help="New folder.", show_default="name of FILE with _again, beside FILE"),
    ] = None,
    run: Annotated[
        int | None,
        typer.Option(help="Number of the run, from 1, if FILE has several.", show_default="last"),
    ] = None,
    namespace: NamespaceOption = None,
) -> None:
    """What if: simulate FILE again with other values, and write a second recording.

    The values of --set stay constant; all other values change as they did in FILE. A command of
    --commands acts from the start of the first interval at or after its time.

    Example: planetary-twin resimulate recordings/NAME --set lambda_ratio=1.0 --from 0.5
    """
    need("recording", "mcap", "rosbags")
    from ..recording.ros2.namespaces import choose_namespace
    from ..recording.ros2.playback import Playback
    from ..recording.runs.branch import Branch
    from ..recording.runs.recorded_commands import recorded_commands
    from ..recording.runs.what_if import resimulate as simulate_again
    from ..recording.tables.command_table import read_commands
    from ..scene.unused import without_effect

    folder = out or file.with_name(f"{file.stem}_again")
    check_recording("--out", folder)
    with one_line_errors():
        changes = settings(set_ or [])
        remarks: list[str] = []
        course = None
        if commands is not None and (commands.is_dir() or commands.suffix == ".mcap"):
            course = recorded_commands(commands, remarks)
        elif commands is not None:
            course = read_commands(commands)
        branch = Branch(changes, from_, duration, run, course)
        chosen = choose_namespace(Playback(file).counts, namespace, file)
        with progress_of("simulating") as show:
            made = simulate_again(file, chosen, branch, folder, show)
    say_units(made.scene, changes)
    for line in (*remarks, *without_effect(made.scene, changes), *made.remarks):
        remark(line)
    line = f"{made.file}: as recorded until {made.begins:g} s, then as set until {made.end:g} s"
    make_console().one_line(line)
