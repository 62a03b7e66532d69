"""Tells a gap between readings from their usual spacing, in the order of their arrival."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

KEPT = 11  # last steps from whose median the usual one follows
WIDE = 3.0  # usual steps that are a gap
SHORTEST = 2.0  # [s] no step up to this is a gap


def longest_steps(before: tuple[float, ...], steps: Array) -> Array:
    """Longest step [s] at each of `steps`, (n,), that is no gap, from those `before`.

    The newest of them is last. It is three times the median of the last eleven steps, and 2 s at
    least.
    """
    past = np.full(KEPT, np.nan)
    known = before[-KEPT:]
    past[KEPT - len(known) :] = known
    every = np.concatenate([past, steps])[:-1] if len(steps) else past
    windows = np.lib.stride_tricks.sliding_window_view(every, KEPT)[: len(steps)]
    limits = np.full(len(steps), SHORTEST)
    some = np.isfinite(windows).any(axis=1)
    limits[some] = np.maximum(WIDE * np.nanmedian(windows[some], axis=1), SHORTEST)
    return limits


def last_steps(before: tuple[float, ...], steps: Array) -> tuple[float, ...]:
    """The steps [s] to keep for the next readings, the newest last."""
    return (*before, *steps.tolist())[-KEPT:]
