"""Texts of the options of `planetary-twin fit`."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ..terminal.settings import numbers


def field_names(text: str) -> tuple[str, ...]:
    """Names in a text, separated by commas.

    Args:
        text: of --observe.
    """
    return tuple(map(_name, _parts(text)))


def free_fields(text: str) -> dict[str, str]:
    """Free fields with their initial values; empty: the value of the scene.

    Args:
        text: NAME or NAME=VALUE, separated by commas.

    Raises:
        ValueError: a name occurs twice.
    """
    found: dict[str, str] = {}
    for part in _parts(text):
        name, _, value = part.partition("=")
        if _name(name) in found:
            raise ValueError(f"free = {_name(name)!r}: given twice")
        found[_name(name)] = value.strip()
    return found


def held_out_span(text: str | None) -> tuple[float, float] | None:
    """Start and end of a part [s].

    Args:
        text: FROM:TO of --hold-out, or None.

    Raises:
        ValueError: the text has another form, or a time is out of range.
    """
    if text is None:
        return None
    try:
        begin, end = map(float, text.split(":"))
    except ValueError:
        raise ValueError(f"--hold-out = {text!r}: must be FROM:TO in seconds") from None
    if not 0.0 <= begin < end < math.inf:
        raise ValueError(f"--hold-out = {text!r}: FROM must be at least 0 and below TO")
    return begin, end


def noise_levels(given: Sequence[str]) -> dict[str, float]:
    """Standard deviations of one reading, in SI.

    Raises:
        ValueError: a value is not a number.
    """
    found = numbers(given, "--noise", "a number in SI")
    return {_name(name): value for name, value in found.items()}


def _name(text: str) -> str:
    return text.strip().replace("-", "_")


def _parts(text: str) -> list[str]:
    return [part for part in text.split(",") if part.strip()]
