"""When a tooth has changed: likelihood of a step of its amount from one hunting period on.

The mean over a window that begins before the change would understate it, so only hunting periods
that surely follow the change give its size.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

LIKELY = 3.0  # units of log-likelihood, within which the true start is in 96 to 99 % of steps by 1
# to 4 standard deviations of one amount


class Onset(NamedTuple):
    """Hunting periods from which the amount of a tooth may have changed, as indices."""

    first: int
    """The earliest one."""
    last: int
    """The latest one; a part of it may precede the change."""


def onset_of(amounts: Array, sd: float) -> Onset:
    """First and last hunting period from which the amounts of a tooth, (n,), may step from zero."""
    count = np.arange(len(amounts), 0, -1)
    sums = np.maximum(np.cumsum(amounts[::-1])[::-1], 0.0)
    gain = sums**2 / (2.0 * count * sd**2)
    likely = np.flatnonzero(gain >= gain.max() - LIKELY)
    return Onset(int(likely[0]), int(likely[-1]))
