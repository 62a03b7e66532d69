"""Exact free motion of one mode, q'' + c q' + w^2 q = 0, fit for vector registers."""

from __future__ import annotations

import math

from .._compile import law
from .._vector_math import precise_exp, sin_cos

FREE = 1e-3  # (w h)^2 + c h below which a mode hardly moves of its own within h
NEARLY_CRITICAL = 1e-4  # phase below which a sine counts as its series


@law
def is_free(square: float, damping: float, h: float) -> bool:
    """Whether a mode hardly moves of its own within h seconds."""
    return square * h * h + damping * h < FREE


@law
def decay_rates(square: float, damping: float) -> tuple[float, float, float]:
    """Angular rate of the wave, or half the gap between two decays, and both decays [1/s]."""
    half = 0.5 * damping
    split = square - half * half
    rate = math.sqrt(abs(split))
    if split >= 0.0:
        return rate, half, half
    return rate, square / (half + rate), half + rate


@law
def wave(damping: float, rate: float, slow: float, fast: float, t: float) -> tuple[float, float]:
    """Free motions after t seconds of a mode from (q, q') = (1, 0) and (0, 1).

    The rates are those of `decay_rates`. Those of the motions are -w^2 times the second, and the
    first less c times the second.
    """
    phase = rate * t
    lasting, fading = precise_exp(-slow * t), precise_exp(-fast * t)
    sine, cosine = sin_cos(phase)
    swings, apart = slow == fast, phase > NEARLY_CRITICAL
    inverse = 1.0 / max(rate, 1e-300)
    swing = lasting * (sine * inverse if apart else t * (1.0 - phase * phase / 6.0))
    creep = 0.5 * (lasting - fading) * inverse
    creep = creep if apart else fading * t * (1.0 + phase + phase * phase / 1.5)
    second = swing if swings else creep
    first = lasting * cosine if swings else 0.5 * (lasting + fading)
    return first + 0.5 * damping * second, second
