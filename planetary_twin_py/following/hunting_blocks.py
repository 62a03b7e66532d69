"""Averages the transmission error over the sun's angle, one block for each hunting period.

1. The waveform common to all mesh cycles, known from earlier blocks, is subtracted from every
   sample at its own angle, so that means over few samples do not depend on their places in a bin.
2. Samples are averaged over bins.
3. A running mean over 7 mesh cycles is subtracted: slow changes of the load, and encoder errors
   that are long compared with a tooth.
4. The mean over all cycles is subtracted.

Of a train that turns slowly, every bin has many samples: 8 to 16 are kept.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .train import FollowedTrain
from .transmission_error import Counts, ErrorOfCounts, ErrorSamples

Array = NDArray[np.float64]

BINS = 20  # in a mesh cycle
FINE = 200  # bins of the common waveform in a mesh cycle
SMOOTHED = 7  # mesh cycles of the running mean
MARGIN = 4  # mesh cycles on both sides of a block that its running mean needs
PRESENT = 0.95  # share of the usual bins within the running mean below which there is a gap
COMPLETE = 0.7  # share of the bins of a block below which it is dropped
WHOLE = 0.95  # share of its cycles below which a block has no mean
KEPT = 0.9  # weight of the earlier common waveform in the next one
CHANGED = 0.1  # relative change of that waveform above which it is learned again
SLIP = 0.5  # tooth pitches by which the error may jump across a gap
DELAY = 0.2  # [s] by which packets may be out of order
BATCH = 0.1  # [s] of samples that are processed at once; affects the cost only
MOST = 16  # samples in a bin, on average, above which a block is thinned


class HuntingBlock(NamedTuple):
    """One hunting period."""

    number: int
    """Number of the hunting period since counting started; decreases while the sun turns back."""
    begin: float
    """[s]."""
    end: float
    """[s]."""
    rate: float
    """Mesh cycles per second, a magnitude."""
    deviation: Array
    """Transmission error by mesh cycle and bin, without its slow and its common part [m],
    (cycles, BINS); 0 where it is not measured."""
    measured: NDArray[np.bool_]
    """Where the deviation is measured, (cycles, BINS)."""
    mean: float
    """Mean transmission error [m]; NaN if much of the block is missing."""
    segment: int
    """Number of times that the count of turns was lost; encoder zeros are valid in one segment."""


class EncoderCounters:
    """Numbers of encoder samples and hunting periods that were not used, by reason."""

    def __init__(self) -> None:
        self.used = 0
        self.late = 0
        """Samples of packets that arrived later than `DELAY`."""
        self.doubled = 0
        self.lost = 0
        """Sample numbers that never arrived."""
        self.dropped_blocks = 0
        """Hunting periods with too many gaps, in which the train reversed, or too long before the
        readings of the torque."""
        self.segments = 1
        """Number of times that the count of turns restarted."""


class HuntingBlocks:
    """Collects samples of two encoders into blocks.

    Args:
        train: gear train with encoders on its input and output.
        counts_per_turn: counts per turn of both encoders.
        period: sample period [s].
    """

    def __init__(
        self, train: FollowedTrain, counts_per_turn: tuple[int, int], period: float
    ) -> None:
        self.period, self.counters = period, EncoderCounters()
        self._cycles = train.hunting_cycles
        self._convert = ErrorOfCounts(train, counts_per_turn)
        self._slip = SLIP * 2.0 * np.pi * train.lever / abs(float(train.cycles))
        self._waiting: list[tuple[Counts, Counts]] = []  # numbers and counts
        self._latest = -1
        self._released = 0  # number of the first sample that may still come
        self._zero: tuple[int, int] | None = None
        self._samples: list[tuple[Counts, ErrorSamples]] = []
        self._most = MOST * BINS * (self._cycles + 2 * MARGIN)
        self._stride = 1  # of the numbers of the samples that a block keeps
        self._range: tuple[int, int] | None = None  # of the cycles of the block and its margins
        self._last_error = np.nan
        self._waveform: Array | None = None
        self._sums: Array | None = None  # of the waveform and of the samples, by fine bin

    def add(self, sample: Counts, counts: Counts) -> Iterator[HuntingBlock]:
        """Add samples in the order of their arrival.

        Args:
            sample: numbers of the samples, (n,): times in sample periods.
            counts: counts of the input and output encoders, (n, 2).

        Returns:
            The hunting periods that are complete now.
        """
        sample, counts = np.asarray(sample, np.int64), np.asarray(counts, np.int64)
        latest = np.maximum.accumulate(np.concatenate([[self._latest], sample]))
        delay = round(DELAY / self.period)
        late = sample < latest[:-1] - delay
        self.counters.late += int(late.sum())
        if len(sample):
            self._waiting.append((sample[~late], counts[~late]))
            self._latest = int(latest[-1])
        if self._latest - delay >= self._released + round(BATCH / self.period):
            yield from self._release(self._latest - delay)

    def finish(self) -> Iterator[HuntingBlock]:
        """Process the samples that are held back, at the end of a recording.

        Returns:
            The hunting periods that are complete now.
        """
        yield from self._release(self._latest + 1)
        yield from self._blocks(last=True)

    def _release(self, until: int) -> Iterator[HuntingBlock]:
        """Process the samples below a number, one hunting period at a time."""
        if not self._waiting or until <= self._released:
            return
        sample = np.concatenate([numbers for numbers, _ in self._waiting])
        counts = np.concatenate([values for _, values in self._waiting])
        order = np.argsort(sample, kind="stable")
        sample, counts = sample[order], counts[order]
        single = np.diff(sample, prepend=self._released - 1) > 0
        self.counters.doubled += int(np.sum(~single))
        ready = single & (sample < until)
        rest = single & (sample >= until)
        self._waiting = [(sample[rest], counts[rest])]
        sample, counts = sample[ready], counts[ready]
        if len(sample):
            expected = int(sample[0]) if self._zero is None else self._released
            self.counters.lost += int(sample[-1]) + 1 - expected - len(sample)
            self._released = int(sample[-1]) + 1
            self.counters.used += len(sample)
            yield from self._segments(sample, counts)

    def _segments(self, sample: Counts, counts: Counts) -> Iterator[HuntingBlock]:
        """Split samples where the count of turns was lost."""
        if self._zero is None:
            self._zero = int(counts[0, 0]), int(counts[0, 1])
        found = self._convert(counts, self._zero)
        steps = np.abs(np.diff(found.error, prepend=self._last_error))
        slipped = np.flatnonzero(steps > self._slip)  # false where the last error is NaN
        if not len(slipped):
            self._last_error = float(found.error[-1])
            self._samples.append((sample, found))
            yield from self._blocks()
            return
        cut = int(slipped[0])
        if cut:
            yield from self._segments(sample[:cut], counts[:cut])
        yield from self._blocks(last=True)
        self._zero, self._last_error = None, np.nan
        self._waveform = self._sums = None
        self.counters.segments += 1
        yield from self._segments(sample[cut:], counts[cut:])

    def _blocks(self, last: bool = False) -> Iterator[HuntingBlock]:
        """Blocks whose samples and margins are complete."""
        while self._samples:
            if not last and self._range is not None:
                newest = self._samples[-1][1].cycle
                if newest.min() >= self._range[0] and newest.max() < self._range[1]:
                    self._thin()
                    return
            self._join()
            sample, found = self._samples[0]
            number = _number(found.cycle, self._cycles)
            if number is None:
                self._thin()
                break
            low = number * self._cycles - MARGIN
            high = low + self._cycles + 2 * MARGIN
            self._range = low, high
            outside = (found.cycle < low) | (found.cycle >= high)
            if not outside.any() and not last:
                self._thin()
                return
            end = int(np.argmax(outside)) if outside.any() else len(sample)
            chosen = np.append(self._chosen(sample[:end]), np.ones(len(sample) - end, dtype=bool))
            sample, found, outside = sample[chosen], _rows(found, chosen), outside[chosen]
            end = int(chosen[:end].sum())
            block = self._block(number, sample[:end], _rows(found, slice(0, end)))
            if block is not None:
                yield block
            if not outside.any():
                break
            ahead = found.cycle[end] >= high
            kept = found.cycle >= high - 2 * MARGIN if ahead else found.cycle < low + 2 * MARGIN
            kept[: end // 2] = False
            kept[end:] = True
            self._samples = [(sample[kept], _rows(found, kept))]
            self._range, self._stride = None, 1
        if last:
            self._samples.clear()
            self._range, self._stride = None, 1

    def _thin(self) -> None:
        """Hold fewer samples of a slow block: a train at rest must not fill the memory."""
        if sum(len(numbers) for numbers, _ in self._samples) > 2 * self._most:
            self._join()
            sample, found = self._samples[0]
            rows = self._chosen(sample)
            self._samples = [(sample[rows], _rows(found, rows))]

    def _chosen(self, sample: Counts) -> NDArray[np.bool_]:
        """Which samples a block keeps: with equal steps, and at most `MOST` in a bin on average."""
        while np.sum(rows := sample % self._stride == 0) > self._most:
            self._stride *= 2
        return rows

    def _join(self) -> None:
        """Concatenate the samples."""
        sample = np.concatenate([numbers for numbers, _ in self._samples])
        columns = zip(*(found for _, found in self._samples), strict=True)
        self._samples = [(sample, ErrorSamples(*(np.concatenate(one) for one in columns)))]

    def _block(self, number: int, sample: Counts, found: ErrorSamples) -> HuntingBlock | None:
        """The block of these samples; None if it has too many gaps or starts a waveform."""
        begin = number * self._cycles
        cycle = found.cycle - begin + MARGIN
        many = self._cycles + 2 * MARGIN
        per_cycle = np.bincount(cycle, minlength=many)
        inside = per_cycle[MARGIN:-MARGIN]
        usual = float(np.median(inside))
        backwards = np.diff(cycle) * (1 if cycle[-1] >= cycle[0] else -1) < -1
        if np.mean(inside > 0.5 * usual) < COMPLETE or usual == 0.0 or backwards.any():
            self.counters.dropped_blocks += 1
            return None
        waveform, self._waveform = self._waveform, self._learned(found, cycle, per_cycle)
        if waveform is None:
            return None
        fine = found.part * FINE - 0.5
        shown = found.error - np.interp(fine, np.arange(-1, FINE + 1), np.pad(waveform, 1, "wrap"))
        cell = cycle * BINS + (found.part * BINS).astype(np.int64)
        count = np.bincount(cell, minlength=many * BINS)
        total = np.bincount(cell, shown, minlength=many * BINS).astype(float)
        rows, shape = slice(MARGIN * BINS, -MARGIN * BINS), (self._cycles, BINS)
        smooth, present = _smoothed(total, count)
        deviation, measured = smooth[rows].reshape(shape), present[rows].reshape(shape)
        own = (cycle >= MARGIN) & (cycle < many - MARGIN)
        times = sample[own][[0, -1]] * self.period
        place = (found.cycle + found.part)[own][[0, -1]]
        there = inside > 0.5 * usual
        means = np.bincount(cycle, found.error, minlength=many)[MARGIN:-MARGIN][there]
        whole = float(np.mean(there)) >= WHOLE
        return HuntingBlock(
            number=number,
            begin=float(times[0]),
            end=float(times[1]),
            rate=float(abs(place[1] - place[0]) / (times[1] - times[0])),
            deviation=without_common(deviation, measured),
            measured=measured,
            mean=float(np.mean(means / inside[there])) if whole else float("nan"),
            segment=self.counters.segments,
        )

    def _learned(self, found: ErrorSamples, cycle: Counts, per_cycle: Counts) -> Array:
        """The waveform common to all cycles, updated with that of this block.

        If the sample rate is a multiple of the mesh frequency, a block has the waveform at few
        angles only. The others are kept from earlier blocks, unless the waveform has changed.
        """
        there = np.flatnonzero(per_cycle)
        means = np.bincount(cycle, found.error)[there] / per_cycle[there]
        slow = np.interp(cycle + found.part, there + 0.5, means)
        fine = (found.part * FINE).astype(np.int64)
        own = np.stack([
            np.bincount(fine, found.error - slow, minlength=FINE),
            np.bincount(fine, minlength=FINE).astype(float),
        ])  # fmt: skip
        if self._sums is not None and _agree(own, self._sums):
            own += KEPT * self._sums
        self._sums = own
        places = np.flatnonzero(own[1])
        waveform = np.interp(np.arange(FINE), places, own[0, places] / own[1, places], period=FINE)
        return np.asarray(waveform - waveform.mean())


def _agree(own: Array, before: Array) -> bool:
    """Whether two waveforms, as sums and counts by fine bin, agree where both are known."""
    both = (own[1] > 0.0) & (before[1] > 0.0)
    one, other = (sums[0, both] / sums[1, both] for sums in (own, before))
    return bool(np.mean((one - other) ** 2) < CHANGED**2 * np.mean(other**2))


def _number(cycle: Counts, cycles: int) -> int | None:
    """Number of the block in which samples begin; None while their direction is unknown."""
    moved = np.flatnonzero(cycle != cycle[0])
    if not len(moved):
        return None
    ahead = cycle[moved[0]] > cycle[0]
    return int(cycle[0] + MARGIN if ahead else cycle[0] - MARGIN) // cycles


def _rows(found: ErrorSamples, rows: slice | NDArray[np.bool_]) -> ErrorSamples:
    return ErrorSamples(found.cycle[rows], found.part[rows], found.error[rows])


def _smoothed(total: Array, count: NDArray[np.intp]) -> tuple[Array, NDArray[np.bool_]]:
    """Means of bins minus their running mean, and where both are measured."""
    present = count > 0
    mean = np.asarray(np.where(present, total / np.maximum(count, 1), 0.0))
    mean -= mean[present].mean()  # no large numbers in the sums
    mean[~present] = 0.0
    window = np.ones(SMOOTHED * BINS + 1)
    window[[0, -1]] = 0.5  # as many bins before as after
    sums = np.convolve(mean, window, "same")
    share = np.convolve(present.astype(float), window, "same") / (SMOOTHED * BINS)
    measured = present & (share >= PRESENT * np.median(share))
    slow = sums / np.maximum(share * SMOOTHED * BINS, 1.0)
    return np.where(measured, mean - slow, 0.0), measured


def without_common(deviation: Array, measured: NDArray[np.bool_]) -> Array:
    """Subtract the part that is common to all mesh cycles.

    Args:
        deviation: deviation by mesh cycle and bin [m], (cycles, BINS).
        measured: where it is measured, (cycles, BINS).

    Returns:
        The deviation [m], 0 where it is not measured, (cycles, BINS).
    """
    common = np.sum(deviation * measured, axis=0) / np.maximum(measured.sum(axis=0), 1)
    return np.asarray((deviation - common) * measured)
