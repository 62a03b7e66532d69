"""How large the aliases are that samples of a run leave in the readings of an accelerometer."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ..scene.sensors.accelerometer import Accelerometer
from .accelerometer import accelerometer
from .reader import Sampling
from .sensed import Sensed

# Shares of lines left as their frequency doubles: forces whose slope jumps, forces that jump.
LEAST_KEPT, MOST_KEPT = 0.25, 0.5

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


def alias_share(sensor: Accelerometer, samples: Sampling, sensed: Sensed) -> float:
    """Estimate the largest alias over the largest line of a sensor without noise.

    What samples show of frequencies near their rate F are aliases, which the filter of the sensor
    passes. Lines of forces that teeth excite decrease as a power of their frequency, so those near
    F are to those near F/2 as those near F/2 are to those near F/4. What the same filter passes of
    these is measured, by samples times cos(pi n) and exp(i pi n/2), which shift them to 0. Their
    ratio counts as 1/4 at least, that of forces whose slope jumps, and 1/2 at most, that of forces
    that jump.

    Args:
        sensor: the sensor.
        samples: from which it reads.
        sensed: the samples, some periods of the slowest line or more.

    Returns:
        The share; 0 if the samples are fewer than the filters need.
    """
    quiet = sensor.model_copy(update={"noise": 0.0, "range": None})

    def spectrum(shift: Callable[[Array], Array] | None = None) -> Complex:
        reader = accelerometer(quiet, samples, shift)
        return _spectrum(reader.read(sensed, len(sensed.angle)).values)

    whole = np.abs(spectrum()).max(initial=0.0)
    half = np.abs(spectrum(_half)).max(initial=0.0)
    quarter = np.abs(spectrum(_cosine) + 1j * spectrum(_sine)).max(initial=0.0)
    if not whole or not quarter:
        return 0.0
    kept = min(max(half / quarter, LEAST_KEPT), MOST_KEPT)
    return float(kept * half / whole)


def _half(number: Array) -> Array:
    return np.asarray(np.cos(math.pi * number))


def _cosine(number: Array) -> Array:
    return np.asarray(np.cos(0.5 * math.pi * number))


def _sine(number: Array) -> Array:
    return np.asarray(np.sin(0.5 * math.pi * number))


def _spectrum(values: Array) -> Complex:
    if not len(values):
        return np.empty(0, dtype=np.complex128)
    return np.asarray(np.fft.fft((values - values.mean()) * np.hanning(len(values))))


def mean_force(sensed: Sensed, planets: int) -> NDArray[np.float64]:
    """Mean forces of the ring meshes, in which part of a mesh cycle does not count [N], (planets,).

    Args:
        sensed: the samples.
        planets: number of planets.
    """
    force = sensed.mesh_force[:, planets:]
    return np.asarray(np.average(force, axis=0, weights=np.hanning(len(force) + 2)[1:-1]))
