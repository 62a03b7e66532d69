"""The command line `planetary-twin`: one file per command.

Each public module here holds one command, a function with the name of the module. Other packages
add commands through the entry-point group `planetary_twin.commands`; the ROS package adds those
that need ROS. What commands share, in both packages, is in `terminal`.
A command is loaded on first use and imports heavy modules only when it runs, so that `--help` and
completion are fast.
"""

from __future__ import annotations

import os
import signal
import sys
from typing import Annotated

import typer

from ..terminal.interrupts import interrupt, repeat_lost, repeat_no_more
from ._commands import Group
from ._help import PLAIN


def build_app() -> typer.Typer:
    """The Typer application with every command that is installed."""
    app = typer.Typer(
        name="planetary-twin",
        cls=Group,
        help="Digital twin of a planetary gearbox: simulate, record, analyse and view it.",
        epilog="Exit codes: 0 success, 1 a check or a run failed, 2 invalid argument, "
        "130 interrupted.",
        no_args_is_help=True,
        rich_markup_mode=PLAIN,
        pretty_exceptions_enable=False,
    )
    app.callback()(_group)
    return app


def _show_version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import version

        typer.echo(version("planetary_twin_py"))
        raise typer.Exit


def _group(
    version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_show_version, is_eager=True, help="Show the version and exit."
        ),
    ] = False,
) -> None:
    """Options of `planetary-twin` itself; Typer makes a group only if there is a callback."""


def main() -> None:
    """Entry point of the console script."""
    repeat_lost(interrupt)
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:  # otherwise it is ignored
        signal.signal(signal.SIGINT, interrupt)
    try:
        try:
            build_app()()
        finally:
            sys.stdout.flush()
    except BrokenPipeError:
        # The reader closed the pipe; flushing it again at exit would print a second error.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(1)
    except KeyboardInterrupt:
        sys.exit(130)
    finally:
        repeat_no_more()
