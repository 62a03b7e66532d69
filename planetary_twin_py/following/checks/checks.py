"""Compares readings with the scene as long as they arrive, of one gearbox or of many.

Readings that contradict the scene as soon as they show a quantity are refused. Later ones are a
remark: a sensor may fail or be connected again at any time.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from .contradictions import CHANNELS, Contradictions, Rows

Array = NDArray[np.float64]

CHECKED = 5.0  # [s] of readings of a follower that are compared together


class Checks:
    """Compares readings with the scene in spans of rows.

    Args:
        contradictions: compares the rows of one gearbox.
        count: number of gearboxes.
        together: rows that are compared together, first and at most: a fault is named soon, and
            more rows at a time cost less.
    """

    def __init__(
        self, contradictions: Contradictions, count: int, together: tuple[int, int]
    ) -> None:
        self.refused: dict[int, str] = {}
        """The first contradiction from the start, by index of the gearbox."""
        self.present: dict[int, str] = {}
        """A contradiction that the last rows still show, by index of the gearbox."""
        self.later: dict[int, dict[str, str]] = {}
        """The first later contradiction of each comparison, by index of the gearbox."""
        self._contradictions, self._count = contradictions, count
        self._together, self._most = together
        self._fewest = together[0]
        self._in_order: list[set[str]] = [set() for _ in range(count)]  # comparisons, once
        self._times: list[float] = []
        self._rows: list[Array] = []  # (channels, count) each

    def agreed(self) -> bool:
        """Whether the torques of the first gearbox were in order once."""
        return "torques" in self._in_order[0]

    def add(self, time: float, row: Mapping[str, Array]) -> bool:
        """Add a row by its end [s], (count,) each in SI; return whether rows were compared."""
        missing = np.full(self._count, np.nan)
        self._times.append(time)
        self._rows.append(np.array([row.get(name, missing) for name in CHANNELS]))
        if len(self._times) < self._together:
            return False
        self.check()
        self._together = min(4 * self._together, self._most)
        return True

    def check(self) -> bool:
        """Compare the rows since the last comparison; return whether there are any."""
        if not self._times:
            return False
        time, read = np.array(self._times), np.array(self._rows)
        self._times.clear()
        self._rows.clear()
        for n in range(self._count):
            shown = self._shown_by(time, read[:, :, n])
            for name, line in shown.items():
                self._note(n, name, line, float(time[0]))
            self.present.pop(n, None)
            if any(shown.values()):
                last = self._shown_by(time[-self._fewest :], read[-self._fewest :, :, n])
                for name in filter(last.get, shown):
                    self.present.setdefault(n, shown[name] or last[name])
        return True

    def _shown_by(self, time: Array, read: Array) -> dict[str, str]:
        """What some rows of a gearbox, (rows, channels), show."""
        return self._contradictions.shown_by(Rows(time, dict(zip(CHANNELS, read.T, strict=True))))

    def _note(self, gearbox: int, name: str, line: str, first: float) -> None:
        """Note the result of a comparison of rows of which the first ends at `first` [s]."""
        if not line:
            self._in_order[gearbox].add(name)
        elif name not in self._in_order[gearbox]:
            self.refused.setdefault(gearbox, line)
        else:
            begin = first - self._contradictions.length
            self.later.setdefault(gearbox, {}).setdefault(
                name,
                f"readings after {begin:.1f} s contradict the scene, and those before did not: "
                f"{line}",
            )
