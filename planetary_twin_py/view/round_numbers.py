"""Round numbers for scales."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

_STEPS = (1.0, 2.0, 5.0, 10.0)


def round_up(value: float) -> float:
    """The smallest of ..., 1, 2, 5, 10, ... that is at least `value` > 0."""
    power = 10.0 ** math.floor(math.log10(value))
    return next(step * power for step in (*_STEPS, 20.0) if step * power >= value * (1.0 - 1e-9))


def round_down(value: float) -> float:
    """The largest of ..., 1, 2, 5, 10, ... that is at most `value` > 0."""
    power = 10.0 ** math.floor(math.log10(value))
    return max(step * power for step in _STEPS if step * power <= value * (1.0 + 1e-9))


def one_digit(value: float) -> float:
    """The smallest number with one significant digit that is at least `value` > 0."""
    power = 10.0 ** math.floor(math.log10(value))
    return power * math.ceil(value / power * (1.0 - 1e-9))


def ticks(low: float, high: float, count: int) -> NDArray[np.float64]:
    """Multiples of a round step from `low` to `high` > `low`, `count` or fewer."""
    step = round_up((high - low) / count)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return np.arange(first, last + 1) * np.float64(step)
