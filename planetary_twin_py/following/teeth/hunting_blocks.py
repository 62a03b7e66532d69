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

from ..train import FollowedTrain
from ..transmission_error import Counts, ErrorOfCounts, ErrorSamples
from .common_waveform import CommonWaveform

Array = NDArray[np.float64]

BINS = 20  # in a mesh cycle
SMOOTHED = 7  # mesh cycles of the running mean
MARGIN = 4  # mesh cycles on both sides of a block that its running mean needs
PRESENT = 0.95  # share of the usual bins within the running mean below which there is a gap
COMPLETE = 0.7  # share of the bins of a block below which it is dropped
WHOLE = 0.95  # share of its cycles below which a block has no mean
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
    """Number of the segment, from 1. The count of turns was lost between two segments, and encoder
    zeros are valid in one of them."""


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
        """Number of segments: one more than the times that the count of turns was lost."""


class HuntingBlocks:
    """Collects samples of two encoders into blocks."""

    def __init__(
        self, train: FollowedTrain, counts_per_turn: tuple[int, int], period: float
    ) -> None:
        self.period, self.counters = period, EncoderCounters()
        self._cycles = train.hunting_cycles
        self._convert = ErrorOfCounts(train, counts_per_turn)
        self._largest_step = SLIP * 2.0 * np.pi * train.lever / abs(float(train.cycles))
        self._waiting: list[tuple[Counts, Counts]] = []  # numbers and counts
        self._latest = -1
        self._released = 0  # number of the first sample that may still come
        self._zero: tuple[int, int] | None = None
        self._samples: list[tuple[Counts, ErrorSamples]] = []
        self._most_samples = MOST * BINS * (self._cycles + 2 * MARGIN)
        self._stride = 1  # of the numbers of the samples that a block keeps
        self._cycle_range: tuple[int, int] | None = None  # of a block with its margins
        self._last_error = np.nan
        self._common = CommonWaveform()

    def add(self, sample: Counts, counts: Counts) -> Iterator[HuntingBlock]:
        """Add numbers of samples (n,) and counts (n, 2); return complete hunting periods."""
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
        """Process the samples that are held back, at the end of a recording."""
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
        distinct = np.diff(sample, prepend=self._released - 1) > 0
        self.counters.doubled += int(np.sum(~distinct))
        ready = distinct & (sample < until)
        pending = distinct & (sample >= until)
        self._waiting = [(sample[pending], counts[pending])]
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
        errors = self._convert(counts, self._zero)
        steps = np.abs(np.diff(errors.error, prepend=self._last_error))
        slipped = np.flatnonzero(steps > self._largest_step)  # false where the last error is NaN
        if not len(slipped):
            self._last_error = float(errors.error[-1])
            self._samples.append((sample, errors))
            yield from self._blocks()
            return
        cut = int(slipped[0])
        if cut:
            yield from self._segments(sample[:cut], counts[:cut])
        yield from self._blocks(last=True)
        self._zero, self._last_error = None, np.nan
        self._common = CommonWaveform()
        self.counters.segments += 1
        yield from self._segments(sample[cut:], counts[cut:])

    def _blocks(self, last: bool = False) -> Iterator[HuntingBlock]:
        """Blocks whose samples and margins are complete."""
        while self._samples:
            if not last and self._cycle_range is not None:
                newest = self._samples[-1][1].cycle
                if newest.min() >= self._cycle_range[0] and newest.max() < self._cycle_range[1]:
                    self._thin_samples()
                    return
            self._join_samples()
            sample, errors = self._samples[0]
            number = _block_number(errors.cycle, self._cycles)
            if number is None:
                self._thin_samples()
                break
            low = number * self._cycles - MARGIN
            high = low + self._cycles + 2 * MARGIN
            self._cycle_range = low, high
            outside = (errors.cycle < low) | (errors.cycle >= high)
            if not outside.any() and not last:
                self._thin_samples()
                return
            end = int(np.argmax(outside)) if outside.any() else len(sample)
            selected = np.append(
                self._thinning_mask(sample[:end]), np.ones(len(sample) - end, dtype=bool)
            )
            sample, errors, outside = (
                sample[selected],
                _select_rows(errors, selected),
                outside[selected],
            )
            end = int(selected[:end].sum())
            block = self._make_block(number, sample[:end], _select_rows(errors, slice(0, end)))
            if block is not None:
                yield block
            if not outside.any():
                break
            forwards = errors.cycle[end] >= high
            carried_over = (
                errors.cycle >= high - 2 * MARGIN if forwards else errors.cycle < low + 2 * MARGIN
            )
            carried_over[: end // 2] = False
            carried_over[end:] = True
            self._samples = [(sample[carried_over], _select_rows(errors, carried_over))]
            self._cycle_range, self._stride = None, 1
        if last:
            self._samples.clear()
            self._cycle_range, self._stride = None, 1

    def _thin_samples(self) -> None:
        """Thin the samples of a slow block: a train at rest must not fill the memory."""
        if sum(len(numbers) for numbers, _ in self._samples) > 2 * self._most_samples:
            self._join_samples()
            sample, errors = self._samples[0]
            rows = self._thinning_mask(sample)
            self._samples = [(sample[rows], _select_rows(errors, rows))]

    def _thinning_mask(self, sample: Counts) -> NDArray[np.bool_]:
        """Which samples a block keeps: with equal steps, and at most `MOST` in a bin on average."""
        while np.sum(rows := sample % self._stride == 0) > self._most_samples:
            self._stride *= 2
        return rows

    def _join_samples(self) -> None:
        """Concatenate the samples."""
        sample = np.concatenate([numbers for numbers, _ in self._samples])
        columns = zip(*(errors for _, errors in self._samples), strict=True)
        self._samples = [(sample, ErrorSamples(*(np.concatenate(parts) for parts in columns)))]

    def _make_block(self, number: int, sample: Counts, errors: ErrorSamples) -> HuntingBlock | None:
        """The block of these samples; None if it has too many gaps or starts a waveform."""
        begin = number * self._cycles
        cycle = errors.cycle - begin + MARGIN
        all_cycles = self._cycles + 2 * MARGIN
        per_cycle = np.bincount(cycle, minlength=all_cycles)
        block_counts = per_cycle[MARGIN:-MARGIN]
        usual_count = float(np.median(block_counts))
        backwards = np.diff(cycle) * (1 if cycle[-1] >= cycle[0] else -1) < -1
        if (
            np.mean(block_counts > 0.5 * usual_count) < COMPLETE
            or usual_count == 0.0
            or backwards.any()
        ):
            self.counters.dropped_blocks += 1
            return None
        waveform = self._common.at(errors.part)
        self._common.update(errors, cycle, per_cycle)
        if waveform is None:
            return None
        residual = errors.error - waveform
        cell = cycle * BINS + (errors.part * BINS).astype(np.int64)
        bin_counts = np.bincount(cell, minlength=all_cycles * BINS)
        bin_sums = np.bincount(cell, residual, minlength=all_cycles * BINS).astype(float)
        rows, shape = slice(MARGIN * BINS, -MARGIN * BINS), (self._cycles, BINS)
        bin_deviation, bin_measured = _subtract_running_mean(bin_sums, bin_counts)
        deviation, measured = bin_deviation[rows].reshape(shape), bin_measured[rows].reshape(shape)
        in_block = (cycle >= MARGIN) & (cycle < all_cycles - MARGIN)
        times = sample[in_block][[0, -1]] * self.period
        position = (errors.cycle + errors.part)[in_block][[0, -1]]
        covered = block_counts > 0.5 * usual_count
        means = np.bincount(cycle, errors.error, minlength=all_cycles)[MARGIN:-MARGIN][covered]
        complete = float(np.mean(covered)) >= WHOLE
        return HuntingBlock(
            number=number,
            begin=float(times[0]),
            end=float(times[1]),
            rate=float(abs(position[1] - position[0]) / (times[1] - times[0])),
            deviation=without_common(deviation, measured),
            measured=measured,
            mean=float(np.mean(means / block_counts[covered])) if complete else float("nan"),
            segment=self.counters.segments,
        )


def _block_number(cycle: Counts, cycles: int) -> int | None:
    """Number of the block in which samples begin; None while their direction is unknown."""
    moved = np.flatnonzero(cycle != cycle[0])
    if not len(moved):
        return None
    forwards = cycle[moved[0]] > cycle[0]
    return int(cycle[0] + MARGIN if forwards else cycle[0] - MARGIN) // cycles


def _select_rows(errors: ErrorSamples, rows: slice | NDArray[np.bool_]) -> ErrorSamples:
    return ErrorSamples(errors.cycle[rows], errors.part[rows], errors.error[rows])


def _subtract_running_mean(
    total: Array, count: NDArray[np.intp]
) -> tuple[Array, NDArray[np.bool_]]:
    """Means of bins minus their running mean, and where both are measured."""
    present = count > 0
    mean = np.asarray(np.where(present, total / np.maximum(count, 1), 0.0))
    mean -= mean[present].mean()  # no large numbers in the sums
    mean[~present] = 0.0
    window = np.ones(SMOOTHED * BINS + 1)
    window[[0, -1]] = 0.5  # as many bins before as after
    sums = np.convolve(mean, window, "same")
    coverage = np.convolve(present.astype(float), window, "same") / (SMOOTHED * BINS)
    measured = present & (coverage >= PRESENT * np.median(coverage))
    running_mean = sums / np.maximum(coverage * SMOOTHED * BINS, 1.0)
    return np.where(measured, mean - running_mean, 0.0), measured


def without_common(deviation: Array, measured: NDArray[np.bool_]) -> Array:
    """Subtract the part that is common to all mesh cycles; 0 where not measured, (cycles, BINS)."""
    common = np.sum(deviation * measured, axis=0) / np.maximum(measured.sum(axis=0), 1)
    return np.asarray((deviation - common) * measured)
