"""Keeps the last rows of a growing table in memory of constant size."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class History:
    """The last rows that were added.

    Args:
        length: number of rows that are kept.
        columns: numbers in a row.
    """

    def __init__(self, length: int, columns: int) -> None:
        # Filled, so that the memory is allocated now and not page by page over hours.
        self._rows = np.full((length, columns), np.nan)
        self._added = 0

    def add(self, *row: float) -> None:
        """Add a row, which replaces the oldest one if all are in use.

        Args:
            row: time, later than those before [s], then the other columns.
        """
        self._rows[self._added % len(self._rows)] = row
        self._added += 1

    def between(self, begin: float, end: float) -> Array:
        """Rows of an interval, in the order of time.

        Args:
            begin: start of the interval, which it does not include [s].
            end: end of the interval, which it includes [s].

        Returns:
            The rows, (n, columns).
        """
        time = self._rows[:, 0]
        rows = self._rows[(begin < time) & (time <= end)]
        return rows[np.argsort(rows[:, 0])]
