"""A sensor with a filter in front of its sampling."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .converter import Converter
from .filters import Decimator, Response
from .high_pass import HighPass
from .path import SensorInput
from .sensed import Readings, Sensed

Array = NDArray[np.float64]


class Filtered:
    """Reads the sum of some signals, each behind a response and that of the sensor.

    Args:
        empty: readings without values, with the name of the sensor and its period.
        received: what arrives at the sensor.
        own: response of the sensor.
        rate: of the samples [Hz].
        first: number of the first sample.
        converter: makes readings of its values.
        amplifier: what is between filter and converter, if anything.
    """

    def __init__(
        self,
        empty: Readings,
        received: SensorInput,
        own: Response,
        rate: float,
        first: int,
        converter: Converter,
        amplifier: HighPass | None = None,
    ) -> None:
        self.empty = empty
        self._received, self._converter, self._amplifier = received, converter, amplifier
        self._ratio = round(rate * empty.period)
        self._rate = rate
        self._parts = [
            Decimator(response.then(own), rate, self._ratio, first)
            for response in received.responses
        ]
        self._number = max(part.next for part in self._parts)
        self._waiting = [np.empty(0) for _ in self._parts]

    def read(self, block: Sensed, count: int) -> Readings:
        """Readings whose filters are complete.

        Args:
            block: consecutive samples.
            count: number of its first samples that are valid.
        """
        signals = self._received.signals(block)
        for n, (part, signal) in enumerate(zip(self._parts, signals, strict=True)):
            number = part.next
            values = part.take(signal[:count])[max(self._number - number, 0) :]
            self._waiting[n] = np.concatenate([self._waiting[n], values])
        complete = min(map(len, self._waiting))
        total = np.zeros(complete)
        for n, values in enumerate(self._waiting):
            total, self._waiting[n] = total + values[:complete], values[complete:]
        return self._converted(total)

    def _converted(self, values: Array) -> Readings:
        number, self._number = self._number, self._number + len(values)
        if self._amplifier is not None:
            values = self._amplifier.take(values[:, None])[:, 0]
        values, clipped = self._converter.convert(number, values)
        first = number * self._ratio / self._rate
        return self.empty._replace(first=first, values=values, clipped=clipped)
