"""Options that take a time: seconds, or a number with a unit such as 10ms."""

from __future__ import annotations

from typing import Any

import typer


def read_seconds(given: str | float) -> float:
    """Convert a time to seconds.

    Args:
        given: number of seconds, or text such as "0.01", "10ms" or "2 min".

    Returns:
        The time [s].

    Raises:
        typer.BadParameter: the text is not a time.
    """
    try:
        return float(given)
    except ValueError:
        pass
    from ..units import to_si  # imports pint, which plain numbers do not need

    try:
        return float(str(to_si(given, "s")))
    except ValueError as error:
        raise typer.BadParameter(
            f"{given!r}: must be a number of seconds, or with a unit, e.g. 10ms ({error})"
        ) from None


SECONDS: dict[str, Any] = {"parser": read_seconds, "metavar": "TIME"}
"""Keyword arguments of `typer.Option` for a time."""
