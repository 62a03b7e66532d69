"""The command line `planetary-twin`: one file per command.

Each public module here holds one command, a function of the module's name. Other packages add
theirs through the entry-point group `planetary_twin.commands`, so that what needs ROS comes with
the ROS package; what they share with the commands here is `_arguments`, `_console`, `_fail`,
`_figures`, `_interrupts` and `_settings`.
A command is loaded when it is asked for, and imports what is heavy only when it runs, so that
`--help` and completion are quick.
"""

from __future__ import annotations

import os
import signal
import sys

import typer

from ._commands import Group
from ._help import PLAIN
from ._interrupts import interrupt, repeat_lost, repeat_no_more


def build_app() -> typer.Typer:
    """The Typer application with every command that is installed."""
    app = typer.Typer(
        name="planetary-twin",
        cls=Group,
        help="Digital twin of a planetary gearbox: run it, record it, look at it.",
        epilog="Exit codes: 0 all is well, 1 something was found that is not, 2 a wrong argument, "
        "130 interrupted.",
        no_args_is_help=True,
        rich_markup_mode=PLAIN,
        pretty_exceptions_enable=False,
    )
    app.callback()(lambda: None)  # without it Typer would make no group
    return app


def main() -> None:
    """Entry point of the console script."""
    repeat_lost(interrupt)
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:  # else it is to be ignored
        signal.signal(signal.SIGINT, interrupt)
    try:
        try:
            build_app()()
        finally:
            sys.stdout.flush()
    except BrokenPipeError:
        # Whoever reads has read enough; Python would complain once more when it closes the pipe.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(1)
    except KeyboardInterrupt:
        sys.exit(130)
    finally:
        repeat_no_more()
