"""The clock of a run: whole seconds, and what has passed since.

So an instant is as sharp after years as at the start, and nothing depends on the age of a run.
"""

from __future__ import annotations

import math
from fractions import Fraction
from functools import lru_cache
from typing import NamedTuple

from .._core import State

LONGEST_CYCLE = 2**52  # [s] after which samples lie on whole seconds again; ticks stay whole


class Instant(NamedTuple):
    """A simulated instant."""

    seconds: int  # whole ones
    time: float  # since then [s]


NEVER = Instant(0, math.inf)


class Sampling(NamedTuple):
    """Where the next sample lies, and the distance between samples."""

    seconds: int  # whole ones
    ticks: int  # since then
    period: int  # ticks
    ticks_per_second: int


def instant(time: float | Fraction) -> Instant:
    """The instant `time` [s]; a fraction is exact however late it is."""
    if isinstance(time, Fraction):  # as below, without a fraction for the difference
        seconds, rest = divmod(time.numerator, time.denominator)
        return Instant(seconds, rest / time.denominator)
    seconds = math.floor(time)
    return Instant(seconds, float(time - seconds))


def sampling(number: int, rate: float) -> Sampling:
    """Sample `number` of those that lie at whole multiples of exactly 1/rate [s]."""
    period, ticks_per_second = _ticks(rate)
    return Sampling(*divmod(number * period, ticks_per_second), period, ticks_per_second)


@lru_cache
def _ticks(rate: float) -> tuple[int, int]:
    """Ticks of a sample and of a second."""
    ratio = Fraction(rate).limit_denominator(LONGEST_CYCLE)
    return ratio.denominator, ratio.numerator


def delay(state: State, until: Instant) -> float:
    """From a state to an instant [s]."""
    return (until.seconds - state.seconds) + (until.time - state.time)


def run_on(begin: State, end: State, h: float) -> None:
    """Let the clock of `end` stand h seconds after that of `begin`."""
    time = begin.time + h
    whole = math.floor(time)
    end.seconds = begin.seconds + whole
    end.time = time - whole
