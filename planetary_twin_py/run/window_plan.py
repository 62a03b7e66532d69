"""Plans windows of a run: their end, and the numbers of their samples."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

from ..model.clock import TICKS
from ..sensors.sensed import Readings
from ..text.number_check import check_number
from .samples import Waves

LEEWAY = 10**6  # a sample may be later than the end of a window by a period over this number
LONGEST_WINDOW = 60.0  # [s], because samples are kept in memory; or
MOST_SAMPLES = 4096  # samples, if that is longer
LOWEST_SAMPLE_RATE = 1.0  # [Hz]


class Plan(NamedTuple):
    """A window before it is computed."""

    begin: int
    """Start [ticks]."""
    end: int
    """End [ticks]."""
    rate: float
    """Sample rate [Hz]."""
    first: int
    """Number of its first sample."""
    waves: Waves
    """Arrays for its samples."""
    repeated: bool
    """Whether mesh cycles are repeated when it starts."""
    given: Mapping[str, float] = MappingProxyType({})
    """Values of the command at the ports, by name."""
    sensors: Mapping[str, Readings] = MappingProxyType({})
    """Readings of the sensors that the window has completed, by name."""


def check_sample_rate(sample_rate: float) -> None:
    """Check a sample rate.

    Args:
        sample_rate: sample rate [Hz].

    Raises:
        ValueError: the value is out of range.
    """
    check_number("sample_rate", sample_rate, "Hz")
    if not LOWEST_SAMPLE_RATE <= sample_rate <= 1e7:
        raise ValueError(f"sample_rate = {sample_rate!r} Hz: must be within 1 and 1e7")


def window_end(begin: int, duration: float, sample_rate: float) -> int:
    """Compute the end of a window.

    Args:
        begin: start of the window [ticks].
        duration: duration of the window [s].
        sample_rate: sample rate [Hz].

    Returns:
        The end [ticks]; exact, so that rounding errors do not accumulate and windows of 10 ms end
        on samples.

    Raises:
        ValueError: the duration is out of range.
    """
    check_number("duration", duration, "s")
    longest = max(LONGEST_WINDOW, MOST_SAMPLES / sample_rate)
    if not 0.0 < duration <= longest:
        raise ValueError(f"duration = {duration!r} s: must be above 0 and at most {longest:g}")
    ticks = round(duration * TICKS)
    if not ticks:
        raise ValueError(f"duration = {duration!r} s: must be at least 1e-12, the clock's step")
    return begin + ticks


def samples_until(ticks: int, sample_rate: float) -> int:
    """Count the samples from time 0 up to a time.

    Args:
        ticks: the time [ticks].
        sample_rate: sample rate [Hz].

    Returns:
        The number of samples after time 0.
    """
    over, under = sample_rate.as_integer_ratio()
    whole = TICKS * under  # in integers: fractions would be reduced at every step
    return (ticks * over * LEEWAY + whole) // (whole * LEEWAY)
