"""Uniformly sampled segments of a signal, which lost messages and changes of the rate separate."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

_TOLERANCE = 0.01  # of the sample period: far above rounding, far below any change of the rate


def uniform_segments(time: NDArray[np.float64]) -> list[slice]:
    """Find the uniformly sampled segments of three or more samples.

    Args:
        time: sample times [s], (n,).

    Returns:
        Indices of the samples of each segment, in order.
    """
    steps = np.diff(time)
    if len(steps) < 2:
        return []
    changes = 1 + np.flatnonzero(np.abs(np.diff(steps)) > _TOLERANCE * np.abs(steps[:-1]))
    edges = [0, *changes.tolist(), len(steps)]
    return [
        slice(begin, end + 1)
        for begin, end in pairwise(edges)
        if end - begin > 1 and steps[begin] > 0.0
    ]


def longest_segment(time: NDArray[np.float64]) -> slice:
    """Find the uniformly sampled segment with the longest duration.

    Args:
        time: sample times [s], (n,).

    Returns:
        Indices of its samples.

    Raises:
        ValueError: there is no uniformly sampled segment.
    """
    segments = uniform_segments(time)
    if not segments:
        raise ValueError(f"time: {len(time)} samples, no three of them uniformly spaced")
    return max(segments, key=lambda part: float(time[part.stop - 1] - time[part.start]))


def sample_rate(time: NDArray[np.float64]) -> float:
    """Sample rate [Hz] of a uniformly sampled segment.

    Args:
        time: its sample times [s], (n,).
    """
    return (len(time) - 1) / float(time[-1] - time[0])


def full_rate(time: NDArray[np.float64]) -> float:
    """Highest sample rate of any segment [Hz]; 0 without a segment.

    Args:
        time: sample times [s], (n,).
    """
    return max((sample_rate(time[part]) for part in uniform_segments(time)), default=0.0)


def reduced_rate(time: NDArray[np.float64], segments: list[slice]) -> str | None:
    """Remark on segments with a lower sample rate than others; a busy machine reduces the rate.

    Args:
        time: sample times [s], (n,).
        segments: from `uniform_segments`.

    Returns:
        A sentence, or None if all segments have the same rate.
    """
    rates = [sample_rate(time[part]) for part in segments]
    full = max(rates, default=0.0)
    few = [k for k, rate in enumerate(rates) if rate < (1.0 - _TOLERANCE) * full]
    if not few:
        return None
    return (
        f"from {time[segments[few[0]].start]:.2f} s on, the sample rate is reduced in places, from "
        f"{full:.0f} to {min(rates):.0f} Hz: components above {0.5 * min(rates):.0f} Hz appear "
        "there as aliases"
    )
