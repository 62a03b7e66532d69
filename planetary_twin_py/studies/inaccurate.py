"""Warnings about the points of a study that are less accurate than its tolerance."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ..checks.accuracy import course_warnings
from ..run.counters import Course
from ..units.catalogue import COURSE

if TYPE_CHECKING:
    import pyarrow as pa


def inaccuracies(table: pa.Table) -> Iterator[str]:
    """Warn about motions that amplify errors beyond the tolerance.

    Args:
        table: table with a row per point, and those columns of `COURSE` that apply.

    Returns:
        A sentence per kind of motion.
    """
    for name in (name for name in COURSE if name in table.column_names):
        values = [value or 0.0 for value in table[name].to_pylist()]
        points, largest = sum(value > 0.0 for value in values), max(values, default=0.0)
        for sentence in course_warnings(_worst(name, largest)):
            yield f"at {points} of {len(table)} points ({name}), at worst: {sentence}"


def _worst(name: str, largest: float) -> Course:
    """Counters that are 0 except for the largest value of a column."""
    if name == "unsettled":
        return Course(unsettled=largest)
    if name == "reversals":
        return Course(reversals=int(largest))
    if name == "both_flanks":
        return Course(both_flanks=int(largest))
    return Course(flank_events=int(largest))
