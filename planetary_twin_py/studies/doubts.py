"""Warnings about the points of a study: clipped friction, missing energy, amplified errors."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ..checks.accuracy import course_warnings
from ..checks.ledger import advice
from ..run.counters import Course
from ..units.catalogue import CLIPPED, COURSE, EXCESS, SIDES, side_title

if TYPE_CHECKING:
    import pyarrow as pa

THRESHOLD = 0.01  # fraction of the time in contact above which clipping is reported


def clipping_of_run(shares: Mapping[str, float], most: str = "") -> str | None:
    """Warning about viscous friction that its law clips to zero at low pressure.

    Args:
        shares: fraction of the time in contact by kind of mesh, from `clipped_friction`.
        most: text before each of them.

    Returns:
        A sentence, or None if no fraction exceeds the threshold.
    """
    clipped = " and ".join(
        f"{most}{100.0 * share:.3g} % ({side_title(side)} meshes)"
        for side, share in shares.items()
        if share > THRESHOLD
    )
    return clipped and (
        f"viscous friction is clipped to zero for {clipped} of the time in contact: "
        "the pressure is too low for its law, and the power loss is underestimated"
    )


def clipping_of_study(table: pa.Table) -> str | None:
    """The same of a study, with the number of points and the largest fraction of time.

    Args:
        table: table from `tabulate`.

    Returns:
        A sentence, or None if no fraction exceeds the threshold.
    """
    shares = {side: _values(table, f"{side}_{CLIPPED}") for side in SIDES}
    largest = {side: float(found.max(initial=0.0)) for side, found in shares.items()}
    points = int(np.any([found > THRESHOLD for found in shares.values()], axis=0).sum())
    line = clipping_of_run(largest, "up to ")
    return line and f"{line}; at {points} of {len(table)} points"


def unbalanced_runs(table: pa.Table) -> str | None:
    """Warning with the number of points whose energy ledger does not balance.

    Args:
        table: table from `tabulate`, with its settings.

    Returns:
        A sentence, or None if the ledgers of all points balance.
    """
    excess = _values(table, EXCESS)
    points, largest = int((excess > 1.0).sum()), float(excess.max(initial=0.0))
    if not points:
        return None
    tolerance = json.loads(table.schema.metadata[b"settings"])["tolerance"]
    return (
        f"the energy ledger does not balance at {points} of {len(table)} points ({EXCESS} up to "
        f"{largest:.3g}); their losses and efficiency are uncertain; {advice(largest, tolerance)}"
    )


def inaccuracies(table: pa.Table) -> Iterator[str]:
    """Warn about motions that amplify errors beyond the tolerance.

    Args:
        table: table with a row per point, and those columns of `COURSE` that apply.

    Returns:
        A sentence per kind of motion.
    """
    for name in COURSE:
        if name not in table.column_names:
            continue
        values = _values(table, name)
        points, largest = int((values > 0.0).sum()), float(values.max(initial=0.0))
        counter = name.removeprefix("unrepeated_")  # none of the steps was repeated
        worst: dict[str, Any] = {counter: largest if name == "unsettled" else int(largest)}
        for sentence in course_warnings(Course(**worst)):
            yield f"at {points} of {len(table)} points ({name}), at worst: {sentence}"


def _values(table: pa.Table, name: str) -> np.ndarray:
    """A column of a table, 0 where a point failed."""
    return np.array([value or 0.0 for value in table[name].to_pylist()])
