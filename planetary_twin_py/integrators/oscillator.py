"""Exact motion of one mode, q'' + c q' + w^2 q = a polynomial of time.

Fast modes: a particular polynomial and a decaying wave. Slow ones, whose particular polynomial
would be a small difference of large numbers: a power series, which ends after a few terms.
"""

from __future__ import annotations

import math

from .._compile import kernel, law

SLOW = 0.5  # (w h)^2 + c h below which a mode is slow
SERIES = 16  # terms: 0.7^16/16! is beyond a double
NEARLY_CRITICAL = 1e-4  # phase below which a sine counts as its series


@law
def is_slow(square: float, damping: float, h: float) -> bool:
    """Whether a mode hardly moves of its own within h seconds."""
    return square * h * h + damping * h < SLOW


@kernel
def wave(square: float, damping: float, t: float) -> tuple[float, float]:
    """Free motions after t seconds of a mode from (q, q') = (1, 0) and (0, 1).

    Their rates are -w^2 times the second, and the first less c times the second.
    """
    half = 0.5 * damping
    split = square - half * half
    if split >= 0.0:
        rate = math.sqrt(split)
        phase = rate * t
        decay = math.exp(-half * t)
        sine = (
            math.sin(phase) / rate if phase > NEARLY_CRITICAL else t * (1.0 - phase * phase / 6.0)
        )
        return decay * (math.cos(phase) + half * sine), decay * sine
    rate = math.sqrt(-split)
    slow, fast = math.exp(-square / (half + rate) * t), math.exp(-(half + rate) * t)
    if rate * t > NEARLY_CRITICAL:
        sine = (slow - fast) / (2.0 * rate)
    else:
        sine = math.exp(-half * t) * t * (1.0 + (rate * t) ** 2 / 6.0)
    return 0.5 * (slow + fast) + half * sine, sine
