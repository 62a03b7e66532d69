"""The waveform of the transmission error that is common to all mesh cycles."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..transmission_error import Counts, ErrorSamples

Array = NDArray[np.float64]

FINE = 200  # bins of the waveform in a mesh cycle
KEPT = 0.9  # weight of the earlier waveform in the next one
CHANGED = 0.1  # relative change above which it is learned again


class CommonWaveform:
    """The waveform by fine bin of a mesh cycle, as known from the blocks so far.

    If the sample rate is a multiple of the mesh frequency, a block has the waveform at few angles
    only. The others are kept from earlier blocks, unless the waveform has changed.
    """

    def __init__(self) -> None:
        self._waveform: Array | None = None  # [m], (FINE,), with a mean of 0
        self._sums: Array | None = None  # of the waveform and of the samples, by fine bin

    def at(self, part: Array) -> Array | None:
        """Values [m] at parts of a mesh cycle, from 0 to 1; None before the first block."""
        if self._waveform is None:
            return None
        wrapped = np.pad(self._waveform, 1, "wrap")
        return np.interp(part * FINE - 0.5, np.arange(-1, FINE + 1), wrapped)

    def update(self, errors: ErrorSamples, cycle: Counts, per_cycle: Counts) -> None:
        """Add the samples of a block, by their cycle in it and their numbers in each cycle."""
        measured_cycles = np.flatnonzero(per_cycle)
        means = np.bincount(cycle, errors.error)[measured_cycles] / per_cycle[measured_cycles]
        trend = np.interp(cycle + errors.part, measured_cycles + 0.5, means)
        fine = (errors.part * FINE).astype(np.int64)
        sums = np.stack([
            np.bincount(fine, errors.error - trend, minlength=FINE),
            np.bincount(fine, minlength=FINE).astype(float),
        ])  # fmt: skip
        if self._sums is not None and _same_waveform(sums, self._sums):
            sums += KEPT * self._sums
        self._sums = sums
        known = np.flatnonzero(sums[1])
        waveform = np.interp(np.arange(FINE), known, sums[0, known] / sums[1, known], period=FINE)
        self._waveform = np.asarray(waveform - waveform.mean())


def _same_waveform(new_sums: Array, old_sums: Array) -> bool:
    """Whether two waveforms, as sums and counts by fine bin, agree where both are known."""
    both = (new_sums[1] > 0.0) & (old_sums[1] > 0.0)
    new, old = (waveform[0, both] / waveform[1, both] for waveform in (new_sums, old_sums))
    return bool(np.mean((new - old) ** 2) < CHANGED**2 * np.mean(old**2))
