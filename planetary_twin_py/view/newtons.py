"""Forces as short texts."""

from __future__ import annotations


def newtons(force: float) -> str:
    """A force with an SI prefix: 900 N, 20 kN, 3 MN."""
    for size, unit in ((1e6, "MN"), (1e3, "kN")):
        if force >= size:
            return f"{force / size:g} {unit}"
    return f"{force:g} N"
