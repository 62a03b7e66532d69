"""Messages on stderr, one line each; a user's error ends the command with exit code 2."""

from __future__ import annotations

from importlib.util import find_spec
from typing import NoReturn

import typer


def fail(message: object, code: int = 2) -> NoReturn:
    """Print `message` as one line and end the command.

    Args:
        message: text, or an exception; one of the system is shown as file and reason.
        code: exit code.

    Raises:
        typer.Exit: always.
    """
    if isinstance(message, OSError) and message.strerror:
        named = () if message.filename is None else (str(message.filename),)
        message = ": ".join((*named, message.strerror))
    _say(f"planetary-twin: {message}", "red")
    raise typer.Exit(code)


def remark(message: str) -> None:
    """Print a warning; the command continues."""
    _say(f"planetary-twin: {message}", "yellow")


def note(message: str) -> None:
    """Print a line that says how an argument was interpreted."""
    _say(f"planetary-twin: {message}", "")


def need(extra: str, *modules: str) -> None:
    """End the command if one of `modules`, which the `extra` installs, is missing."""
    if any(find_spec(module) is None for module in modules):
        fail(f"required packages are missing: pip install 'planetary_twin_py[{extra}]'")


def _say(line: str, colour: str) -> None:
    from rich.console import Console  # honours NO_COLOR and pipes

    from ..printable import printable

    Console(stderr=True).print(
        printable(line), style=colour, markup=False, highlight=False, soft_wrap=True
    )
