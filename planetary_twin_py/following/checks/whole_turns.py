"""Adds the whole turns of encoders that count within one turn, or within the range of a counter.

A counter that wraps jumps by its range. Between two samples no shaft turns so far, so a jump that
leaves a step of the shaft beside the range is a wrap, and not a loss of counts.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..transmission_error import Counts
from .sample_check import ENCODERS as NAMES
from .sample_check import CountCheck


class WholeTurns:
    """Continues the counts of two encoders where their counters wrap."""

    def __init__(self, check: CountCheck) -> None:
        self._check = check
        self._last: tuple[int, Counts] | None = None  # number and counts of the last sample
        self._span: tuple[Counts, Counts] | None = None  # smallest and largest counts
        self._offset = np.zeros(2, dtype=np.int64)
        self._range = [0, 0]  # of a counter that has wrapped
        self._wraps: list[list[float]] = [[], []]  # number, and time of the first [s]

    def add(self, sample: Counts, counts: Counts) -> tuple[Counts, Counts]:
        """Add numbers of samples, (n,), and counts, (n, 2); return the sound ones.

        Their counts contain whole turns.
        """
        sound = self._check.judge(sample, counts)
        sample, counts = sample[sound], counts[sound]
        if not len(sample):
            return sample, counts
        before = (int(sample[0]), counts[0]) if self._last is None else self._last
        number = np.concatenate([[before[0]], sample])
        read = np.concatenate([before[1][None], counts])
        self._last = int(sample[-1]), counts[-1].copy()
        low, high = counts.min(axis=0), counts.max(axis=0)
        if self._span is not None:
            low, high = np.minimum(low, self._span[0]), np.maximum(high, self._span[1])
        self._span = low, high
        added = np.stack(
            [
                self._added(k, number, read[:, k], int(high[k]) - int(low[k]))
                for k in range(len(NAMES))
            ], axis=1,
        )  # fmt: skip
        offset = self._offset + np.cumsum(added, axis=0)
        self._offset = offset[-1]
        return sample, counts + offset

    def remarks(self) -> Iterator[str]:
        """A line for each encoder whose counter wraps, or whose counts jumped."""
        yield from self._check.remarks()
        for name, size, turn, wraps in zip(
            NAMES, self._range, self._check.counts_per_turn, self._wraps, strict=True
        ):
            if wraps:
                yield (
                    f"encoders: {name} jumps by {size} ({size / turn:.6g} turns) {wraps[0]:.0f} "
                    f"times, first at {wraps[1]:.3f} s, as a counter that wraps: the turns are "
                    "added"
                )

    def _added(self, k: int, number: Counts, read: Counts, span: int) -> Counts:
        """What the wraps of an encoder add at each sample, (n,)."""
        step = np.diff(read)
        reach = self._check.reach[k] * np.maximum(np.abs(np.diff(number)), 1)
        added = np.zeros(len(step), dtype=np.int64)
        for n in np.flatnonzero(np.abs(step) > reach):
            size = self._range[k] or self._range_of(k, abs(int(step[n])), int(reach[n]))
            left = abs(int(step[n])) - size
            if size and span <= size and abs(left) <= reach[n] and 4 * reach[n] < size:
                added[n] = -size if step[n] > 0 else size
                self._range[k] = size
                if not self._wraps[k]:
                    self._wraps[k] = [0.0, float(number[n + 1]) * self._check.period]
                self._wraps[k][0] += 1.0
        return added

    def _range_of(self, k: int, jump: int, reach: int) -> int:
        """Range of a counter that jumps so far; 0 if it is none."""
        sizes = self._check.sizes[k]
        nearest = int(sizes[np.argmin(np.abs(sizes - jump))])
        return nearest if abs(nearest - jump) <= reach else 0
