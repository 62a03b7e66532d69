"""One comparison of the page, and its verdict."""

from __future__ import annotations

from typing import NamedTuple

AGREES, MISSES, INPUT, UNDECIDED = "agrees", "**misses**", "input", "undecided"
PREDICTION = "prediction"


class Row(NamedTuple):
    """A figure of the source, the twin's, the verdict, and a remark on the comparison."""

    what: str
    measured: str
    twin: str
    verdict: str
    remark: str


def verdict(agrees: bool) -> str:
    """The word for the verdict column."""
    return AGREES if agrees else MISSES
