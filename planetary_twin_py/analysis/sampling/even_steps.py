"""Signals whose time stamps drift, at equal steps of time.

Samples that are taken late by the time d turn a tone of frequency f by the phase 2 pi f d. Its line
loses the share P^2/2 of its height, where P is the rms of these phases over the signal [rad].
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from .interpolation import interpolated

Array = NDArray[np.float64]
PHASE = 0.14  # [rad] rms at half the sample rate, with which lines there are 1 % too low


def drifts(time: Array) -> bool:
    """Whether stamps deviate from equal steps by more than `PHASE` at half the sample rate.

    Stamps that a logger rounds to a tenth of a step do not.

    Args:
        time: time stamps [s], (n,), increasing.
    """
    if len(time) <= 2:
        return False
    numbers = np.arange(len(time)) / (len(time) - 1)
    late = time - np.polynomial.Polynomial.fit(numbers, time, 1)(numbers)
    step = (time[-1] - time[0]) / (len(time) - 1)
    return math.pi * float(np.std(late)) / step > PHASE


def at_equal_steps(time: Array) -> Array:
    """As many times [s] at equal steps between the first and the last stamp, (n,).

    Args:
        time: time stamps [s], (n,), increasing.
    """
    return np.linspace(time[0], time[-1], len(time))


def resampled(samples: Array, time: Array) -> Array:
    """Values of a signal `at_equal_steps`.

    Args:
        samples: at the stamps, in any unit, (n,), n at least 8.
        time: time stamps [s], (n,), increasing by nearly equal steps.
    """
    places = np.interp(at_equal_steps(time), time, np.arange(len(time)))
    return interpolated(samples, places)


def drift_remark(time: Array) -> str:
    """A sentence that says that samples were interpolated, and how far the stamps drift.

    Args:
        time: time stamps [s], (n,), increasing.
    """
    late = float(np.abs(time - at_equal_steps(time)).max())
    rate = (len(time) - 1) / float(time[-1] - time[0])
    return (
        f"the time stamps deviate from equal steps by up to {late * rate:.3g} samples "
        f"({late:.2g} s): the samples are interpolated at {rate:.6g} Hz"
    )
