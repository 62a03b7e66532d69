"""Random numbers of the noise of a sensor, by the numbers of its samples."""

from __future__ import annotations

import zlib

import numpy as np
from numpy.typing import NDArray

BLOCK = 1024  # random numbers drawn at once


class Noise:
    """Standard normal random numbers that depend on the numbers of the samples alone.

    Args:
        seed: seed of the sensor.
        name: name of the sensor, so that sensors with the same seed differ.
    """

    def __init__(self, seed: int, name: str) -> None:
        self._key = [seed, zlib.crc32(name.encode())]
        self._number, self._block = -1, np.empty(0)

    def at(self, first: int, count: int) -> NDArray[np.float64]:
        """Random numbers of consecutive samples.

        Args:
            first: number of the first sample, from 0.
            count: number of samples.

        Returns:
            The numbers, (count,).
        """
        values = np.empty(count)
        number = first
        while number < first + count:
            block, begin = divmod(number, BLOCK)
            some = min(BLOCK - begin, first + count - number)
            values[number - first :][:some] = self._drawn(block)[begin : begin + some]
            number += some
        return values

    def _drawn(self, block: int) -> NDArray[np.float64]:
        if block != self._number:
            chance = np.random.default_rng([*self._key, block])
            self._number, self._block = block, chance.standard_normal(BLOCK)
        return self._block
