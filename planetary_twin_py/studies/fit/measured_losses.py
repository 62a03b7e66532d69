"""Refuses measured losses that no gearbox has."""

from __future__ import annotations

from bisect import bisect_right
from itertools import groupby

import numpy as np

from ...model.clock import TICKS
from ...recording.tables.possible_losses import MEASURED, impossible_loss
from .excerpt import Excerpt


def check_losses(excerpt: Excerpt) -> None:
    """Raise `ValueError` if a loss of a table of a rig is negative or above the input power."""
    if not excerpt.measured:
        return
    times = [change.time for change in excerpt.changes]
    rows = list(zip(excerpt.intervals, excerpt.states, strict=True))
    for change, part in groupby(rows, lambda row: bisect_right(times, row[0].begin / TICKS) - 1):
        intervals, states = zip(*part, strict=True)
        columns = {name: np.array([getattr(one, name) for one in states]) for name in MEASURED}
        values = excerpt.changes[change].values if change >= 0 else {}
        found = impossible_loss(columns, excerpt.scene.replace(**values))
        if found is not None:
            end = intervals[found.row].end / TICKS
            raise ValueError(f"interval that ends at {end:g} s: {found.statement}")
