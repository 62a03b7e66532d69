"""`--set NAME=VALUE`: changes of a scene typed on the command line."""

from __future__ import annotations

from collections.abc import Sequence


def settings(given: Sequence[str]) -> dict[str, str]:
    """Names and values of settings, for `Scene.replace`.

    Raises:
        ValueError: one is not NAME=VALUE.
    """
    values = {}
    for setting in given:
        name, equals, value = setting.partition("=")
        if not (name and equals):
            raise ValueError(f"--set {setting!r}: must be NAME=VALUE")
        values[name] = value
    return values
