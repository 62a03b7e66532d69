"""How a command ends on a user's error: one line on stderr, exit code 2."""

from __future__ import annotations

from importlib.util import find_spec
from typing import NoReturn

import typer


def fail(message: object) -> NoReturn:
    """Print `message` as one line and end the command."""
    typer.secho(f"planetary-twin: {message}", fg="red", err=True)
    raise typer.Exit(2)


def remark(message: str) -> None:
    """Print a line that the user should know but that ends nothing."""
    typer.secho(f"planetary-twin: {message}", fg="yellow", err=True)


def need(extra: str, *modules: str) -> None:
    """End the command where the `extra` that brings `modules` is not installed."""
    if any(find_spec(module) is None for module in modules):
        fail(f"this needs more packages: pip install 'planetary_twin_py[{extra}]'")
