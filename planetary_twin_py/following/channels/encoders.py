"""Two encoders on the input and output members, read by one device: messages and tables."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...recording.tables.measurements import TIME, missing_column, read_columns
from ...units.conversion import LARGEST
from ..input_error import InputError
from .block_tables import time_shift
from .sampled import COUNTS, SAMPLE
from .stamp import stamp_of

SET = 1.0  # [s] difference of stamps and sample numbers above which a clock must have been set


class EncoderFormat(NamedTuple):
    """Format of two encoders on the input and output members, read by one device."""

    counts_per_turn: tuple[int, int]
    """Counts per turn of the input and of the output."""
    period: float
    """Sample period [s]."""

    def __str__(self) -> str:
        """The numbers."""
        first, second = self.counts_per_turn
        return f"{first}, {second}, {self.period:g} s"


class EncoderSamples(NamedTuple):
    """Counts of two encoders, in the order of their arrival."""

    sample: NDArray[np.int64]
    """Numbers of the samples, (n,): times in sample periods."""
    counts: NDArray[np.int64]
    """Counts of the input and the output encoder, (n, 2): with whole turns, or of counters that
    wrap after a turn or a power of two."""
    format: EncoderFormat | None = None
    """Format of the encoders; None: that given to the follower."""

    @property
    def device(self) -> str:
        """Name of the device."""
        return "encoders"

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the channels."""
        return COUNTS

    def stamps(self, known: EncoderFormat | None = None) -> NDArray[np.float64]:
        """Stamps [s], (n,).

        Args:
            known: format if the samples do not state it.

        Raises:
            ValueError: neither is known.
        """
        if (encoder_format := self.format or known) is None:
            raise ValueError("encoders: their counts per turn and their period are missing")
        return np.asarray(self.sample * encoder_format.period)

    def part(self, rows: slice) -> EncoderSamples:
        """Some of the samples."""
        return self._replace(sample=self.sample[rows], counts=self.counts[rows])


class EncoderMessages:
    """Converts blocks of counts to samples, which are numbered from time 0 of the stamps."""

    def __init__(self) -> None:
        self._format: EncoderFormat | None = None
        self._first_number: int | None = None  # of a device's sample 0, in periods since time 0

    def unused(self, block: Any) -> str:
        """Why a block is not used: it has the counts of one encoder."""
        both = block.input_counts_per_turn and block.output_counts_per_turn
        only_one = not both and len(block.input_counts) != len(block.output_counts)
        return "counts of one encoder, and teeth need both of one device" if only_one else ""

    def read(self, sender: str, block: Any) -> EncoderSamples:
        """Convert a block of a topic.

        Raises `InputError` if it has another format than the one before, or none.
        """
        counts = np.array([block.input_counts, block.output_counts], dtype=np.int64)
        encoder_format = EncoderFormat(
            (int(block.input_counts_per_turn), int(block.output_counts_per_turn)),
            float(block.sample_period),
        )
        line = f"{sender}: counts per turn and period are {encoder_format}: must be"
        if min(encoder_format.counts_per_turn) < 1 or not 0.0 < encoder_format.period < 1.0:
            raise InputError(f"{line} at least 1 and within 0 and 1 s")
        if encoder_format != (self._format or encoder_format):
            raise InputError(f"{line} {self._format} as in the blocks before")
        self._format = encoder_format
        begin = round(stamp_of(block) / encoder_format.period)
        first = int(block.first_sample)
        deviation = 0 if self._first_number is None else abs(self._first_number + first - begin)
        if self._first_number is None or deviation * encoder_format.period > SET:
            self._first_number = begin - first
        numbers = self._first_number + first + np.arange(counts.shape[1], dtype=np.int64)
        return EncoderSamples(numbers, counts.T, encoder_format)

    def join(self, blocks: Sequence[EncoderSamples]) -> EncoderSamples:
        """Join successive samples."""
        return EncoderSamples(
            np.concatenate([block.sample for block in blocks]),
            np.concatenate([block.counts for block in blocks]),
            blocks[0].format,
        )


def read_encoders(path: Path, period: float, begin: np.datetime64 | None = None) -> EncoderSamples:
    """Read a table of the counts of two encoders.

    Args:
        path: path of a .csv, .parquet or .mat file with the columns input_counts and output_counts,
            and either the number `sample` or the `time`, in seconds of the stamps of the readings
            or in dates.
        period: sample period [s].
        begin: date of second 0 of the stamps of the readings; None if they have no dates.

    Returns:
        The samples, in the order of the rows.

    Raises:
        ValueError: a column is missing or has values other than whole numbers, the times are
            not multiples of the period, or they are dates and those of the readings are not.
        OSError: the file cannot be read.
    """
    columns = read_columns(path)
    for name in COUNTS:
        if name not in columns:
            raise missing_column(path, name, columns)
    counts = np.stack(
        [_whole_numbers(path, name, columns[name].in_si(name, "")) for name in COUNTS], axis=1
    )
    if SAMPLE in columns:
        sample = _whole_numbers(path, SAMPLE, columns[SAMPLE].in_si(SAMPLE, ""))
    elif TIME[0] in columns:
        number = columns[TIME[0]].in_si(TIME[0], "s") / period
        if not np.all((np.abs(number - np.round(number)) < 0.2) & (np.abs(number) <= LARGEST)):
            raise ValueError(
                f"{path}: time: must be multiples of {period:g} s; is the sample rate right?"
            )
        shift = round(time_shift(path, columns[TIME[0]], begin) / period)
        sample = np.round(number).astype(np.int64) + shift
    else:
        raise ValueError(f"{path}: column {SAMPLE!r} or {TIME[0]!r}: missing")
    if not len(sample):
        raise ValueError(f"{path}: has no rows")
    return EncoderSamples(sample, counts)


def _whole_numbers(path: Path, name: str, values: NDArray[np.float64]) -> NDArray[np.int64]:
    for row in np.flatnonzero(~(np.isfinite(values) & (values == np.round(values))))[:1]:
        raise ValueError(f"{path}: row {row + 1}: {name} = {values[row]:g}: must be a whole number")
    return values.astype(np.int64)
