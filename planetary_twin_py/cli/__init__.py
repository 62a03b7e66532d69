"""The command line `planetary-twin`: one file per command.

Each public module here holds one command, a function of the module's name. Other packages add
theirs through the entry-point group `planetary_twin.commands`, so that what needs ROS comes with
the ROS package. Command modules import what is heavy only when they run, so that `--help` is quick.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable
from importlib.metadata import entry_points

import typer

from ._fail import fail

GROUP = "planetary_twin.commands"


def build_app() -> typer.Typer:
    """The Typer application with every command that is installed."""
    app = typer.Typer(
        name="planetary-twin",
        help="Digital twin of a planetary gearbox: run it, record it, look at it.",
        epilog="Exit codes: 0 all is well, 1 something was found that is not, 2 a wrong argument.",
        no_args_is_help=True,
        rich_markup_mode="rich",
        pretty_exceptions_show_locals=False,
    )
    app.callback()(lambda: None)  # with a single command Typer would drop the command's name
    for module in pkgutil.iter_modules(__path__):
        if not module.name.startswith("_"):
            loaded = importlib.import_module(f"{__name__}.{module.name}")
            command = getattr(loaded, module.name)
            app.command(name=module.name, context_settings=getattr(loaded, "CONTEXT", None))(
                command
            )
    for entry in sorted(entry_points(group=GROUP), key=lambda entry: entry.name):
        try:
            command = entry.load()
        except ImportError as reason:
            command = _out_of_order(entry.name, reason)
        if isinstance(command, typer.Typer):
            app.add_typer(command, name=entry.name)
        else:
            app.command(name=entry.name)(command)
    return app


def _out_of_order(name: str, reason: ImportError) -> Callable[[], None]:
    """A command that cannot be loaded must not take the others, and the doctor, with it."""

    def command() -> None:
        fail(f"{name}: {reason}; planetary-twin doctor tells more")

    command.__doc__ = "Out of order: see planetary-twin doctor."
    return command


def main() -> None:
    """Entry point of the console script."""
    build_app()()
