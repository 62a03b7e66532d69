"""Points of a study that are less accurate than its tolerance says, in words."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ..accuracy import Course, course_warnings

if TYPE_CHECKING:
    import pyarrow as pa


def inaccuracies(table: pa.Table) -> Iterator[str]:
    """A sentence for each kind of motion that outgrows the tolerance at points of a study.

    Args:
        table: of `tabulate`.
    """
    names = ("unsettled", "reversals", "both_flanks", "unrepeated_flank_events")
    for name in names:
        found = [value or 0.0 for value in table[name].to_pylist()]
        points, most = sum(value > 0.0 for value in found), max(found, default=0.0)
        for sentence in course_warnings(_worst(name, most)):
            yield f"at {points} of {len(table)} points ({name}), at worst: {sentence}"


def _worst(name: str, most: float) -> Course:
    """A course with nothing but the largest value of a column."""
    if name == "unsettled":
        return Course(unsettled=most)
    if name == "reversals":
        return Course(reversals=int(most))
    if name == "both_flanks":
        return Course(both_flanks=int(most))
    return Course(flank_events=int(most))
