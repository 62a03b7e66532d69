"""Keeps the last rows of a growing table in memory of constant size."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class History:
    """The last rows that were added, at most `length`."""

    def __init__(self, length: int, columns: int) -> None:
        # Filled, so that the memory is allocated now and not page by page over hours.
        self._rows = np.full((length, columns), np.nan)
        self._added = 0

    def add(self, *row: float) -> None:
        """Add a row: a time, later than those before [s], and its columns."""
        self._rows[self._added % len(self._rows)] = row
        self._added += 1

    def between(self, begin: float, end: float) -> Array:
        """Rows after `begin` and until `end` [s], in the order of time, (n, columns)."""
        time = self._rows[:, 0]
        rows = self._rows[(begin < time) & (time <= end)]
        return rows[np.argsort(rows[:, 0])]
