"""What a sensor adds to its values: errors, noise, a range and the bits of its converter."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .noise import Noise

Array = NDArray[np.float64]


class ErrorModel(NamedTuple):
    """Errors of a sensor, or their standard deviations."""

    noise: float
    """Standard deviation of a reading, in SI."""
    zero: float
    """In SI."""
    gain: float

    def reading(self, value: Array, normal: Array) -> Array:
        """What the sensor reads: (1 + gain) value + zero + noise.

        Args:
            value: true values in SI, (n,).
            normal: standard normal random numbers, (n,).

        Returns:
            Readings in SI, (n,).
        """
        return value * (1.0 + self.gain) + self.zero + self.noise * normal


class Converter:
    """Makes readings of values.

    Args:
        errors: errors of the sensor.
        noise: its random numbers.
        range: largest magnitude in SI; None: no limit and no bits.
        bits: of the converter, over twice the range.
    """

    def __init__(
        self, errors: ErrorModel, noise: Noise, range: float | None = None, bits: int = 24
    ) -> None:
        self._errors, self._noise, self._range, self._bits = errors, noise, range, bits

    def convert(self, first: int, values: Array) -> tuple[Array, int]:
        """Readings of consecutive samples, and how many of them are clipped.

        Args:
            first: number of the first sample.
            values: in SI, (n,).
        """
        read = self._errors.reading(values, self._noise.at(first, len(values)))
        if self._range is None:
            return read, 0
        clipped = int((np.abs(read) > self._range).sum())
        step = 2.0 * self._range / 2**self._bits
        return step * np.round(np.clip(read, -self._range, self._range) / step), clipped
