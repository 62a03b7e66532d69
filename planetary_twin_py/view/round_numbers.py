"""Round numbers for scales, with one significant digit."""

from __future__ import annotations

import math


def round_up(value: float) -> float:
    """The smallest number with one significant digit that is at least `value` > 0."""
    power = 10.0 ** math.floor(math.log10(value))
    return power * math.ceil(value / power * (1.0 - 1e-9))


def round_down(value: float) -> float:
    """The largest number with one significant digit that is at most `value` > 0."""
    power = 10.0 ** math.floor(math.log10(value))
    return power * math.floor(value / power * (1.0 + 1e-9))
