"""How a command ends on a user's error: one line on stderr, exit code 2."""

from __future__ import annotations

from typing import NoReturn

import typer


def fail(message: object) -> NoReturn:
    """Print `message` as one line and end the command."""
    typer.secho(f"planetary-twin: {message}", fg="red", err=True)
    raise typer.Exit(2)


def remark(message: str) -> None:
    """Print a line that the user should know but that ends nothing."""
    typer.secho(f"planetary-twin: {message}", fg="yellow", err=True)


def need_plots() -> None:
    """End the command where the extra for plots is not installed."""
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        fail("the plots are not installed: pip install 'planetary_twin_py[plots]'")


def need_peers() -> None:
    """End the command where the extra for the solvers to compare with is not installed."""
    try:
        import CyRK  # noqa: F401
        import sksundae  # noqa: F401
    except ImportError:
        fail("the peers are not installed: pip install 'planetary_twin_py[bench]'")
