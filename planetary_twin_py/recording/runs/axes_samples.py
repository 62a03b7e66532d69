"""Samples of axes that move, read from the file on demand."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from .waveform import Source, Stored, read_stored, stored_at, times

CENTRAL = 3  # sun, ring, carrier
Vectors = NDArray[np.float32]


@dataclass
class AxesSamples:
    """Every sample of every axis: `time` [s] and `stamp` [ns] (n,).

    Bodies are sun, ring, carrier, planet_1..N. `displacement` [m] and `bearing_force` [N] are
    (n, bodies, 2) on the carrier, `orbit` [m] of the first three (n, 3, 2) in the housing.
    """

    time: NDArray[np.float64]
    stamp: NDArray[np.int64]
    displacement: Vectors
    bearing_force: Vectors
    orbit: Vectors


class AxesBlocks(Protocol):
    """The recorded blocks of one gearbox whose axes move, in memory or in a file."""

    def samples(self, begin: float, end: float) -> AxesSamples | None:
        """Samples of all blocks that overlap the time span [s]; None if there are none."""


class AxesInFile:
    """The recorded blocks in a file, in its order."""

    def __init__(self) -> None:
        self._stored: list[Stored] = []

    def add(self, source: Source, place: int, rows: NDArray[Any]) -> None:
        """Add messages from the section at position `place` of a file.

        Raises:
            RecordingError: samples are missing in a message.
        """
        rows = rows[rows["samples"] > 0]
        if len(rows):
            series = {name: 2 * bodies for name, bodies in _bodies(rows).items()}
            self._stored.append(stored_at(source, place, rows, series))

    def samples(self, begin: float, end: float) -> AxesSamples | None:
        """Samples of all blocks that overlap the time span [s]; None if there are none."""
        return axes_samples_of(read_stored(self._stored, begin, end))


@dataclass
class AxesInMemory:
    """Blocks in memory."""

    found: AxesSamples | None

    def samples(self, begin: float, end: float) -> AxesSamples | None:
        """Samples within the time span [s]; None if there are none."""
        if self.found is None:
            return None
        part = (begin <= self.found.time) & (self.found.time <= end)
        columns = (getattr(self.found, name)[part] for name in AxesSamples.__dataclass_fields__)
        return AxesSamples(*columns) if part.any() else None


def axes_samples_of(messages: Iterable[NDArray[Any]]) -> AxesSamples | None:
    """The samples of structured arrays of AxesWaveform; None if there are none."""
    arrays = [rows[rows["samples"] > 0] for rows in messages]
    arrays = [rows for rows in arrays if len(rows)]
    if not arrays:
        return None
    columns = {
        name: np.concatenate(
            [
                message.reshape(bodies, 2, -1).transpose(2, 0, 1)
                for rows in arrays
                for message, bodies in zip(rows[name], _bodies(rows)[name], strict=True)
            ],
            dtype=np.float32,
        )
        for name in ("displacement", "bearing_force", "orbit")
    }
    time, stamp = times(arrays)
    return AxesSamples(time, stamp, **columns)


def joined_axes(parts: Sequence[AxesSamples]) -> AxesSamples | None:
    """Concatenate parts; None if there are none."""
    if not parts:
        return None
    names = AxesSamples.__dataclass_fields__
    return AxesSamples(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))


def _bodies(rows: NDArray[Any]) -> dict[str, NDArray[np.int64]]:
    """Number of bodies in each message, by quantity."""
    every = rows["planets"].astype(np.int64) + CENTRAL
    of_members = np.full(len(rows), CENTRAL)
    return {"displacement": every, "bearing_force": every, "orbit": of_members}
