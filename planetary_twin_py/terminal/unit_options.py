"""Options that take a time or a frequency: a number in SI, or with a unit such as 10ms."""

from __future__ import annotations

import math
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
    return _read(given, "s", "a number of seconds, or with a unit, e.g. 10ms")


def read_hertz(given: str | float) -> float:
    """Convert a frequency to hertz.

    Args:
        given: number of hertz, or text such as "50000" or "50kHz".

    Returns:
        The frequency [Hz].

    Raises:
        typer.BadParameter: the text is not a frequency.
    """
    return _read(given, "Hz", "a number of hertz, or with a unit, e.g. 50kHz")


def _read(given: str | float, unit: str, required: str) -> float:
    try:
        return float(given)
    except ValueError:
        pass
    from ..units.conversion import to_si  # imports pint, which plain numbers do not need

    try:
        return float(str(to_si(given, unit)))
    except ValueError as error:
        raise typer.BadParameter(f"{given!r}: must be {required} ({error})") from None


def read_quantity(option: str, text: str, unit: str) -> float:
    """Convert the value of an option to SI.

    Args:
        option: its name, for messages.
        text: number in SI, or with a unit.
        unit: SI unit.

    Raises:
        ValueError: the text is not such a quantity, or not finite.
    """
    from ..units.conversion import to_si

    try:
        value = float(str(to_si(text, unit)))
    except ValueError as error:
        raise ValueError(f"{option} = {text!r}: {error}") from None
    if not math.isfinite(value):
        raise ValueError(f"{option} = {text!r}: must be finite")
    return value


SECONDS: dict[str, Any] = {"parser": read_seconds, "metavar": "TIME"}
"""Keyword arguments of `typer.Option` for a time."""
HERTZ: dict[str, Any] = {"parser": read_hertz, "metavar": "FREQUENCY"}
"""Keyword arguments of `typer.Option` for a frequency."""
