"""Filters between the teeth and the samples of a sensor, as one convolution each.

The response of a path and of the sensor, and the filter that stops aliases, are one finite impulse
response: that of their product over frequency.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.signal import fftconvolve, firwin, kaiserord

PASSED = 0.4  # of the sample rate: up to there the filter is flat
STOPPED = 0.6  # from there on it stops: aliases of it lie above PASSED
ATTENUATION = 80.0  # [dB] of what it stops
OVERSAMPLING = 4  # least ratio of the rates before and after
DECAYS = 10.0  # time constants after which a response is cut off: 5e-5 are left

Array = NDArray[np.float64]
Response = Callable[[Array], NDArray[np.complex128]]


class Path(NamedTuple):
    """A signal and what filters it on its way."""

    signal: Array
    """Samples before the path, (samples,)."""
    response: Response
    """Complex response at frequencies [rad/s], (n,)."""
    decay: float
    """Time constant of the response [s]."""


def unchanged(omega: Array) -> NDArray[np.complex128]:
    """Response of a path that passes everything, (n,)."""
    return np.ones(len(omega), dtype=complex)


def low_pass(ratio: int) -> Array:
    """Linear-phase filter for a sensor that takes one of `ratio` samples.

    Flat within 0.1 % up to 0.4 of the rate of the sensor, 80 dB down from 0.6 on (Kaiser's window;
    Oppenheim and Schafer 2010, section 7.6).

    Args:
        ratio: rate of the signal over that of the sensor.

    Returns:
        Coefficients, an odd number of them.
    """
    width = 2.0 * (STOPPED - PASSED) / ratio  # of half the rate of the signal
    count, beta = kaiserord(ATTENUATION, width)
    return np.asarray(firwin(count | 1, (PASSED + STOPPED) / ratio, window=("kaiser", beta)))


def sampled(
    paths: Sequence[Path], sensor: Response, decay: float, rate: float, ratio: int
) -> tuple[Array, int]:
    """Sum of some paths, through a sensor, at the rate of the sensor.

    Args:
        paths: signals at `rate`, all equally long.
        sensor: response of the sensor.
        decay: time constant of the sensor [s].
        rate: of the signals [Hz].
        ratio: `rate` over the rate of the sensor.

    Returns:
        The samples (n,), and the number of the sample of the signals at which the first one is
        taken. Where the filters would need samples from outside the signals there is none.
    """
    stop = low_pass(ratio)
    half, parts = len(stop) // 2, list[Array]()
    for path in paths:
        tail = math.ceil(DECAYS * (path.decay + decay) * rate)
        parts.append(_taps(stop, path.response, sensor, rate, tail))
    length, past = len(paths[0].signal), max(map(len, parts)) - 1 - half
    first = -(-past // ratio) * ratio
    if length - half <= first:
        return np.empty(0), first
    total = np.zeros(length - half - first)
    for path, taps in zip(paths, parts, strict=True):
        # entry n of the full convolution is the output at sample n - half
        total += fftconvolve(path.signal, taps)[first + half : length]
    return total[::ratio], first


def _taps(stop: Array, path: Response, sensor: Response, rate: float, tail: int) -> Array:
    """Impulse response of everything, (len(stop) + tail,); its time 0 is the middle of `stop`."""
    count = len(stop) + tail
    size = 1 << (2 * count - 1).bit_length()
    omega: Array = np.asarray(math.tau * rate * np.fft.rfftfreq(size), dtype=np.float64)
    spectrum = np.multiply(np.fft.rfft(stop, size), path(omega) * sensor(omega))
    return np.fft.irfft(spectrum, size)[:count]
