"""How large the aliases are that samples of a run leave in the readings of an accelerometer."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..scene.sensors.accelerometer import Accelerometer
from .accelerometer import accelerometer
from .reader import Sampling
from .sensed import Sensed

DECREASE = 0.5  # of the lines near the rate of the samples over those near half of it, at most


def alias_share(
    sensor: Accelerometer, samples: Sampling, sensed: Sensed, values: NDArray[np.float64]
) -> float:
    """Estimate the largest alias over the largest line of a sensor.

    What samples show of frequencies near their rate are aliases, which the filter of the sensor
    passes. Lines of forces that jump as teeth engage decrease as 1/frequency, those of smoother
    ones faster, so aliases are at most half as large as what the same filter passes of frequencies
    near half the rate, which is measured: every second sample is negated, which exchanges them for
    those near 0.

    Args:
        sensor: the sensor.
        samples: from which it reads.
        sensed: all samples.
        values: readings of the sensor.

    Returns:
        The share, 0 without readings.
    """
    quiet = sensor.model_copy(update={"noise": 0.0, "range": None})
    reader = accelerometer(quiet, samples, folded=True)
    near_half = reader.read(sensed, len(sensed.angle)).values
    largest = _largest_line(values)
    return DECREASE * _largest_line(near_half) / largest if largest else 0.0


def _largest_line(values: NDArray[np.float64]) -> float:
    if not len(values):
        return 0.0
    spectrum = np.fft.rfft((values - values.mean()) * np.hanning(len(values)))
    return float(np.abs(spectrum).max())
