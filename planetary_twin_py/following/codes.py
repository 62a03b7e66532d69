"""Recognises the codes that loggers and converters write for a missing or saturated reading."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .channels.sensor import Sensor

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

CODES = np.sort(
    [
        *(sign * value for value in (999.0, 9999.0, 99999.0, 999999.0) for sign in (-1.0, 1.0)),
        -99.0, -888.0, -8888.0, -7999.0, -6999.0, 32767.0, -32768.0, 32768.0, 65535.0,
        8388607.0, -8388608.0, 2147483647.0, -2147483648.0, 4294967295.0,
    ]
)  # fmt: skip
EXACT = 1e-6  # relative error of a code after a conversion of its unit
FAR = 0.5  # relative change of a reading above which it may be a code


class Codes:
    """Judges the readings of a channel in the order of their arrival.

    A channel that passes the value of a code slowly has no code there.

    Args:
        sensor: sensor of the channel.
        nominal: magnitude of a reading at the operating point of the scene, in SI.
        scale: factor that the readings have; a code has none.
        count: number of gearboxes.
    """

    def __init__(self, sensor: Sensor, nominal: float, scale: float, count: int) -> None:
        self._sensor, self._nominal, self._scale = sensor, nominal, scale
        self._usual = np.full(count, np.nan)  # last reading that equals no code

    def judge(self, values: Array) -> Mask:
        """Find codes.

        Args:
            values: readings in SI, (n, count); NaN where one is missing.

        Returns:
            Which readings are codes, (n, count).
        """
        equal = self._equals_code(values / self._scale)
        usual = np.isfinite(values) & ~equal
        row = np.where(usual, np.arange(len(values))[:, None], -1)
        last = np.maximum.accumulate(row, axis=0)
        before = np.take_along_axis(values, np.maximum(last, 0), axis=0)
        before = np.where(last >= 0, before, self._usual)
        self._usual = before[-1]
        if not equal.any():
            return equal
        before = np.where(np.isnan(before), np.copysign(self._nominal, values), before)
        return equal & ~(np.abs(values - before) <= FAR * np.abs(before))

    def _equals_code(self, values: Array) -> Mask:
        """Which readings equal a code in one of the usual units."""
        found = np.zeros(np.shape(values), dtype=bool)
        for written in self._sensor.as_written(values):
            whole = np.rint(written)
            code = CODES[np.minimum(np.searchsorted(CODES, whole), len(CODES) - 1)]
            found |= (whole == code) & (np.abs(written - whole) <= EXACT * np.abs(code))
        return found
