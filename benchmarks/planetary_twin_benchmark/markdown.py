"""Tables for pages of the documentation, narrow enough for a small screen."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from .timing import Speed


def markdown_table(titles: Sequence[str], lines: Iterable[Sequence[str]]) -> str:
    """A Markdown table with `titles` above `lines`, without a line break at the end."""
    rows = [titles, ("---",) * len(titles), *lines]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in rows)


def three_digits(value: float) -> str:
    """A number with three significant digits and without an exponent if it is large."""
    return f"{float(f'{value:.3g}'):g}"


def speed_cell(speed: Speed) -> str:
    """The median speed and, in brackets, the slowest and the fastest round; `-` for NaN."""
    if math.isnan(speed.median):
        return "-"
    return f"{three_digits(speed.median)} ({three_digits(speed.low)}-{three_digits(speed.high)})"
