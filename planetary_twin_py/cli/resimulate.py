"""`planetary-twin resimulate`: a recorded run again, with other values from an instant on."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ._arguments import FileArgument, NamespaceOption, SetOption
from ._console import make_console
from ._fail import fail, need, remark
from ._output import check_recording
from ._settings import say_units, settings


def resimulate(
    file: FileArgument,
    set_: SetOption = None,
    from_: Annotated[
        float, typer.Option("--from", help="Simulated instant from which it differs [s].")
    ] = 0.0,
    duration: Annotated[
        float | None, typer.Option(help="Length of the new run [s]; as recorded unless given.")
    ] = None,
    out: Annotated[
        Path | None, typer.Option(help="New folder; by default beside FILE, its name and _again.")
    ] = None,
    run: Annotated[
        int | None, typer.Option(help="Which run, from 1, if there are several; or the last.")
    ] = None,
    namespace: NamespaceOption = None,
) -> None:
    """Ask what would have been: simulate FILE again with other values, into a second recording.

    What is set stays so; everything else changes when it was changed in FILE.

    Example: planetary-twin resimulate recordings/NAME --set lambda_ratio=1.0 --from 3.0
    """
    need("recording", "mcap", "rosbags")
    from rich.progress import Progress

    from ..recording.ros2.namespaces import choose_namespace
    from ..recording.ros2.tape import Tape
    from ..recording.runs.branch import Branch
    from ..recording.runs.what_if import resimulate as simulate_again

    folder = out or file.with_name(f"{file.stem}_again")
    check_recording("--out", folder)
    console = make_console()
    try:
        changes = settings(set_ or [])
        branch = Branch(changes, from_, duration, run)
        chosen = choose_namespace(Tape(file).topics, namespace, file)
        with Progress(console=console, transient=True, disable=not console.is_terminal) as progress:
            task = progress.add_task("simulating", total=None)
            made = simulate_again(
                file,
                chosen,
                branch,
                folder,
                lambda time, end: progress.update(task, completed=time, total=end),
            )
    except OSError as error:
        fail(f"{error.filename}: {error.strerror}")
    except ValueError as error:
        fail(error)
    say_units(made.scene, changes)
    for line in made.remarks:
        remark(line)
    told = f"as recorded up to {made.begins:g} s, then as set up to {made.end:g} s: {made.file}"
    console.print(told, highlight=False, soft_wrap=True)
