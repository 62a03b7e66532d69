"""The clock of a run: whole seconds and a remainder.

So the resolution of time does not depend on the age of a run.
"""

from __future__ import annotations

import math
from fractions import Fraction
from functools import lru_cache
from typing import NamedTuple

from .._core import State

TICKS = 10**12  # of the clock of windows per second: exact, and a whole number of each
LONGEST_CYCLE = 2**52  # [s] after which samples lie on whole seconds again; ticks stay whole


class Instant(NamedTuple):
    """A simulated instant."""

    seconds: int  # whole seconds
    time: float  # remainder [s]


NEVER = Instant(0, math.inf)


def instant_of_ticks(ticks: int) -> Instant:
    """The instant after so many TICKS."""
    seconds, rest = divmod(ticks, TICKS)
    return Instant(seconds, rest / TICKS)


class Sampling(NamedTuple):
    """Instant of the next sample and sampling period."""

    seconds: int  # whole seconds
    ticks: int  # remainder
    period: int  # [ticks]
    ticks_per_second: int


def instant(time: float | Fraction) -> Instant:
    """The instant `time` [s]; a `Fraction` is exact at any age of the run."""
    if isinstance(time, Fraction):  # as below, without a fraction for the difference
        seconds, rest = divmod(time.numerator, time.denominator)
        return Instant(seconds, rest / time.denominator)
    seconds = math.floor(time)
    return Instant(seconds, float(time - seconds))


def sampling(number: int, rate: float) -> Sampling:
    """Sample `number` of the samples at exact integer multiples of 1/rate [s]."""
    period, ticks_per_second = _ticks(rate)
    return Sampling(*divmod(number * period, ticks_per_second), period, ticks_per_second)


@lru_cache
def _ticks(rate: float) -> tuple[int, int]:
    """Ticks per sample and per second."""
    ratio = Fraction(rate).limit_denominator(LONGEST_CYCLE)
    return ratio.denominator, ratio.numerator


def delay(state: State, until: Instant) -> float:
    """Time from a state to an instant [s]."""
    return (until.seconds - state.seconds) + (until.time - state.time)


def run_on(begin: State, end: State, h: float) -> None:
    """Set the clock of `end` to h [s] after the clock of `begin`."""
    time = begin.time + h
    whole = math.floor(time)
    end.seconds = begin.seconds + whole
    end.time = time - whole
