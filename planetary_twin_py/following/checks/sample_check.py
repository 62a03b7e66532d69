"""Leaves out samples of encoders that jump away and back, and codes in samples of vibration."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ...recording.tables.codes import far_codes
from ..channels.speed import HIGHEST
from ..train import FollowedTrain
from ..transmission_error import Counts
from .left_out import LeftOut, Span

Array = NDArray[np.float64]

ENCODERS = "input_counts", "output_counts"
JUMPS = "the counts jump further than the shaft can turn, and come back"
RANGES = 2 ** np.arange(8, 49)
"""Ranges of counters, beside the counts of a turn."""
RESTARTED = 20  # changes of counts that have jumped, after which the counter has a new zero
CODE = "the value is a code for a missing or saturated reading"


class CountCheck:
    """Judges the counts of two encoders in the order of their arrival.

    Counters may wrap. Those that jump and go on from there have a new zero; they are used, so that
    wrong counts per turn are recognised later.
    """

    def __init__(
        self, train: FollowedTrain, counts_per_turn: tuple[int, int], period: float
    ) -> None:
        turns = HIGHEST * train.speed_limit / (2.0 * math.pi) * period  # of the input
        self.reach = np.ceil(
            [turns * counts_per_turn[0], turns * abs(train.ratio) * counts_per_turn[1]]
        ).astype(np.int64)  # largest steps in a period
        self.sizes = [np.append(RANGES, counts) for counts in counts_per_turn]
        """Ranges of the counters of both encoders."""
        self.counts_per_turn, self.period, self._rows = counts_per_turn, period, 0
        self._sound: tuple[int, Counts] | None = None  # number and counts of the last sound sample
        self._last: tuple[int, Counts] | None = None  # of the last one
        self._jump: list[Span | None] = []  # what has jumped since the last sound one, by encoder
        self._changes = 0  # of the counts since the jump
        self._near = np.zeros(2, dtype=np.int64)  # half of the jump
        self._left_out = LeftOut()

    def judge(self, sample: Counts, counts: Counts) -> NDArray[np.bool_]:
        """Which samples, (n,), with the counts of both encoders, (n, 2), are sound."""
        used = np.ones(len(sample), dtype=bool)
        begin, k = 0, self._rows + 1
        while begin < len(sample):
            rest = sample[begin:], counts[begin:]
            if self._jump:
                end = begin + self._jumping(*rest)
                used[begin:end] = False
                self._note(sample[begin:end], counts[begin:end], k + begin)
                if end < len(sample):
                    self._end_jump(int(sample[end]), counts[end])
            else:
                end = begin + self._sound_until(*rest)
                if end < len(sample):
                    self._start_jump(int(sample[end]), counts[end])
            begin = end
        self._rows += len(sample)
        return used

    def remarks(self) -> Iterator[str]:
        """A line for each encoder whose counts jumped."""
        for line in self._left_out.remarks():
            yield f"encoders: {line}"

    def _far(self, numbers: Counts, steps: Counts) -> NDArray[np.bool_]:
        """Which steps are further than a shaft turns, and no wraps of a counter, (n, 2)."""
        reach = self.reach * np.maximum(np.abs(numbers), 1)[:, None]
        far = np.asarray(np.abs(steps) > reach)
        for k in np.flatnonzero(far.any(axis=0)):
            rows = np.flatnonzero(far[:, k])
            beside = np.abs(np.abs(steps[rows, k])[:, None] - self.sizes[k])
            within = reach[rows, k][:, None]
            wraps = (beside <= within) & (4 * within < self.sizes[k])
            far[rows, k] = ~wraps.any(axis=1)
        return far

    def _steps_from(
        self, before: tuple[int, Counts] | None, sample: Counts, counts: Counts
    ) -> tuple[Counts, Counts]:
        """Differences of successive samples, the first from one before."""
        first = (sample[:1], counts[:1]) if before is None else ([before[0]], before[1][None])
        return np.diff(sample, prepend=first[0]), np.diff(counts, axis=0, prepend=first[1])

    def _sound_until(self, sample: Counts, counts: Counts) -> int:
        """Number of samples before a jump."""
        far = self._far(*self._steps_from(self._sound, sample, counts)).any(axis=1)
        end = int(np.argmax(far)) if far.any() else len(sample)
        if end:
            self._sound = self._last = int(sample[end - 1]), counts[end - 1].copy()
        return end

    def _start_jump(self, number: int, counts: Counts) -> None:
        assert self._sound is not None  # a jump is one from a sound sample
        self._jump, self._changes = [None, None], 0
        steps = (counts - self._sound[1])[None]
        far = self._far(np.array([number - self._sound[0]]), steps)
        self._near = np.where(far, np.abs(steps) // 2, np.iinfo(np.int64).max)[0]

    def _is_away(self, sample: Counts, counts: Counts) -> NDArray[np.bool_]:
        """Which samples are still far from the last sound one, (n, 2)."""
        assert self._sound is not None  # see `_start_jump`
        steps = counts - self._sound[1]
        return self._far(sample - self._sound[0], steps) | (np.abs(steps) > self._near)

    def _jumping(self, sample: Counts, counts: Counts) -> int:
        """Number of samples before one that is back, or of a counter with a new zero."""
        back = ~self._is_away(sample, counts).any(axis=1)
        _, steps = self._steps_from(self._last, sample, counts)
        changes = self._changes + np.cumsum(steps.any(axis=1))
        ended = back | (changes >= RESTARTED)
        end = int(np.argmax(ended)) if ended.any() else len(sample)
        if end:
            self._changes = int(changes[end - 1])
            self._last = int(sample[end - 1]), counts[end - 1].copy()
        return end

    def _note(self, sample: Counts, counts: Counts, row: int) -> None:
        """Note samples that have jumped, by encoder."""
        far = self._is_away(sample, counts)
        for k in np.flatnonzero(far.any(axis=0)):
            wrong = far[:, k]
            time, rows = sample[wrong] * self.period, row + np.flatnonzero(wrong)
            new = Span.of(np.asarray(time, float), counts[wrong, k].astype(float), rows)
            before = self._jump[k]
            self._jump[k] = new if before is None else before.joined(new)

    def _end_jump(self, number: int, counts: Counts) -> None:
        """Go on after a jump; if the counts are back, what jumped is left out."""
        if not self._is_away(np.array([number]), counts[None]).any():
            for name, span in zip(ENCODERS, self._jump, strict=True):
                if span is not None:
                    self._left_out.add_span(name, JUMPS, span)
        self._sound = self._last = number, counts.copy()
        self._jump = []


class VibrationCheck:
    """Judges samples of vibration in the order of their arrival."""

    def __init__(self, names: tuple[str, ...]) -> None:
        self._names, self._rows = names, 0
        self._squares, self._count = np.zeros(len(names)), np.zeros(len(names))
        self._left_out = LeftOut()

    def judge(self, time: Array, values: Array) -> Array:
        """The samples, (n, channels), with NaN for codes that are far from the samples before."""
        rows = self._rows + np.arange(1.0, len(time) + 1.0)
        self._rows += len(time)
        kept = np.array(values, dtype=float)
        wrong, self._squares, self._count = far_codes(kept, self._squares, self._count)
        for k in np.flatnonzero(wrong.any(axis=0)):
            own = wrong[:, k] & np.isfinite(time) & np.isfinite(kept[:, k])
            if own.any():
                self._left_out.add(self._names[k], CODE, time[own], kept[own, k], rows[own])
        kept[wrong] = math.nan
        return kept

    def remarks(self) -> Iterator[str]:
        """A line for each channel with codes."""
        for line in self._left_out.remarks():
            yield f"vibration: {line}"
