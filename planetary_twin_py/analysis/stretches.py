"""Where samples follow one another evenly: lost messages and changed sample rates break them."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

_EVEN = 0.01  # of the sample period: far above rounding, far below any change of rate


def even_stretches(time: NDArray[np.float64]) -> list[slice]:
    """Stretches of three or more samples at equal distances in `time` [s] (n,), in order."""
    steps = np.diff(time)
    if len(steps) < 2:
        return []
    changes = 1 + np.flatnonzero(np.abs(np.diff(steps)) > _EVEN * np.abs(steps[:-1]))
    edges = [0, *changes.tolist(), len(steps)]
    return [
        slice(begin, end + 1)
        for begin, end in pairwise(edges)
        if end - begin > 1 and steps[begin] > 0.0
    ]


def longest_stretch(time: NDArray[np.float64]) -> slice:
    """The stretch that lasts longest; raises `ValueError` where there is none."""
    stretches = even_stretches(time)
    if not stretches:
        raise ValueError(f"time: {len(time)} samples, of which no three lie at equal distances")
    return max(stretches, key=lambda part: float(time[part.stop - 1] - time[part.start]))


def sample_rate(time: NDArray[np.float64]) -> float:
    """Of an even stretch [Hz]."""
    return (len(time) - 1) / float(time[-1] - time[0])


def full_rate(time: NDArray[np.float64]) -> float:
    """The highest of any stretch [Hz]; 0 where there is none."""
    return max((sample_rate(time[part]) for part in even_stretches(time)), default=0.0)


def thinned(time: NDArray[np.float64], stretches: list[slice]) -> str | None:
    """A remark, where samples are further apart than elsewhere: a busy machine thins them."""
    rates = [sample_rate(time[part]) for part in stretches]
    full = max(rates, default=0.0)
    few = [k for k, rate in enumerate(rates) if rate < (1.0 - _EVEN) * full]
    if not few:
        return None
    return (
        f"from {time[stretches[few[0]].start]:.2f} s on, some samples come at {min(rates):.0f} in "
        f"place of {full:.0f} Hz: spectra show there what folds back from above half of that"
    )
