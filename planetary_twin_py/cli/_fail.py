"""How a command ends on a user's error: one line on stderr, exit code 2."""

from __future__ import annotations

from importlib.util import find_spec
from typing import NoReturn

import typer


def fail(message: object, code: int = 2) -> NoReturn:
    """Print `message` as one line and end the command."""
    _say(f"planetary-twin: {message}", "red")
    raise typer.Exit(code)


def remark(message: str) -> None:
    """Print a line that the user should know but that ends nothing."""
    _say(f"planetary-twin: {message}", "yellow")


def note(message: str) -> None:
    """Print a line that says how something was understood."""
    _say(f"planetary-twin: {message}", "")


def need(extra: str, *modules: str) -> None:
    """End the command where the `extra` that brings `modules` is not installed."""
    if any(find_spec(module) is None for module in modules):
        fail(f"this needs more packages: pip install 'planetary_twin_py[{extra}]'")


def _say(line: str, colour: str) -> None:
    from rich.console import Console  # which knows where colours are not wanted

    from ..printable import printable

    Console(stderr=True).print(
        printable(line), style=colour, markup=False, highlight=False, soft_wrap=True
    )
