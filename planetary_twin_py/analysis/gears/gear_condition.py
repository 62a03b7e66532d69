"""Condition of one gear from a signal: its average, indicators with intervals, and their limits."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...gearset.kinematics import Teeth
from ..sampling import interpolation
from ..shaft import orders
from ..signals.signal import Signal
from .block_intervals import FEWEST_BLOCKS, Interval, bootstrap, jackknife
from .gear_signals import GearSignals, gear_signals
from .indicators import ConditionIndicators, condition_indicators
from .planet_separation import Separated
from .synchronous_average import SynchronousAverage, time_synchronous_average

Array = NDArray[np.float64]
GEARS = ("sun", "planet", "ring")
MOST_PER_TURN = 1 << 15  # samples per turn of an average
MAXIMA = "peak", "crest_factor", "fm0"  # indicators of the largest values
MOST_NOISE = 0.5  # of the rms of the difference signal: noise above it hides faults


class Passing(NamedTuple):
    """Where planet 1 is at a sensor."""

    angle: float
    """Of the carrier since the first sample [rad]."""
    found: bool
    """Whether it was found, and not stated."""
    equal: bool
    """Whether the planets are equally spaced, so that the first to pass is called planet 1."""

    def remarks(self) -> Iterator[str]:
        """Which planet this is, if that was found."""
        if self.found:
            name = "; planet 1 is the first to pass" if self.equal else ""
            yield (
                f"planet 1 passes the sensor {math.degrees(self.angle):.3g} deg of the carrier "
                f"after the first sample, where the vibration is highest{name}; if it is known, "
                "state --passing"
            )


class GearCondition(NamedTuple):
    """Condition of a gear."""

    teeth: int
    """Of the gear."""
    average: SynchronousAverage
    """Over the turns that were used."""
    period: int
    """Turns after which the same teeth meet."""
    parts: GearSignals
    """Of the average."""
    indicators: ConditionIndicators
    """Of the average."""
    intervals: dict[str, Interval] | None
    """Indicators with their intervals, by name; None with fewer than six turns."""
    separated: Separated | None = None
    """Windows around the passes of one planet; each turn of `average` is a cycle of passes in which
    every tooth is seen. None without."""
    passing: Passing | None = None
    """Where planet 1 was at the sensor; None without separation."""

    @property
    def difference(self) -> float:
        """Rms of the difference signal, in the unit of the signal."""
        return float(np.sqrt(np.mean(self.parts.difference**2)))

    def remarks(self, simulated: bool) -> Iterator[str]:
        """What limits the meaning of the indicators.

        Args:
            simulated: whether the signal is one of a twin, which has no noise.
        """
        turns, rms = len(self.average.turns), self.indicators.rms
        if self.intervals is None:
            of = "turns of the gear"
            if self.separated is not None:
                of = f"cycles of {self.separated.seen.turns} passes of the planet"
            yield f"no intervals: they need {FEWEST_BLOCKS} {of}, the signal has {turns}"
        if turns % self.period:
            yield (
                f"the same teeth meet after {self.period} turns of the gear, and the average is of "
                f"{turns}: errors of the mating gear are left in it"
            )
        if simulated:
            yield (
                "this signal has no noise of a sensor: FM4, M6A, M8A, NB4 and the energy operator "
                "are of any small difference as high as of a large one; compare the rms of the "
                "difference with that of a healthy gear (--baseline)"
            )
        if 0.0 < self.difference < interpolation.ERROR * rms:
            yield (
                f"the difference signal is less than {100.0 * interpolation.ERROR:g} % of the "
                "signal, so it may be a product of the interpolation"
            )
        elif self.average.noise > MOST_NOISE * self.difference:
            yield (
                "what does not repeat with the gear, such as noise, is still "
                f"{self.average.noise / self.difference:.2g} times the difference signal in the "
                "average, so indicators of the difference are those of noise; a longer record "
                "lowers it"
            )


def gear_condition(
    signal: Signal, teeth: Teeth, gear: str, mesh: str | None, healthy: Signal | None = None
) -> GearCondition:
    """Average a signal over the turns of a gear relative to the carrier, and compute indicators.

    Args:
        signal: of a mesh or of a sensor.
        teeth: tooth numbers.
        gear: one of `GEARS`.
        mesh: name of the mesh, which must contain the gear; None for a sensor.
        healthy: the same signal of the healthy gear, for NA4*.

    Returns:
        The condition. Turns are whole meshing periods if the signal contains one.

    Raises:
        ValueError: the mesh does not contain the gear, the sun reverses or rests relative to the
            carrier, or the signal has fewer than two turns of the gear.
    """
    if gear not in GEARS:
        raise ValueError(f"gear = {gear!r}: must be one of {', '.join(GEARS)}")
    if mesh is not None and gear not in mesh.split("_"):
        raise ValueError(f"gear = {gear!r}: is not in the mesh {mesh!r}")
    count, ratio = getattr(teeth, gear), teeth.sun / getattr(teeth, gear)
    points = _points(signal, count, ratio)
    whole = time_synchronous_average(signal.samples, signal.angle, points, ratio)
    period = _period(teeth, gear, mesh)
    used = _used(whole.turns, period)
    average = SynchronousAverage(whole.angle, used.mean(axis=0), used)
    sound = None
    if healthy is not None:
        turns = time_synchronous_average(healthy.samples, healthy.angle, points, ratio).turns
        sound = _used(turns, period).mean(axis=0)[np.newaxis]
    return condition_of(average, count, sound, quantisation(signal.samples), period)


def condition_of(
    average: SynchronousAverage,
    teeth: int,
    healthy: Array | None,
    resolution: float,
    period: int = 1,
) -> GearCondition:
    """Indicators of an average, with intervals from the scatter of its turns.

    Args:
        average: of the gear.
        teeth: of the gear.
        healthy: average of the healthy gear, (1, points); None if there is none.
        resolution: rms of the rounding of the samples.
        period: turns after which the same teeth meet.
    """

    def figures(one: Array) -> dict[str, float]:
        found = condition_indicators(one, teeth, healthy=healthy, resolution=resolution)
        return {name: value for name, value in found._asdict().items() if name != "reasons"}

    turns = average.turns
    return GearCondition(
        teeth,
        average,
        period,
        gear_signals(average.average, teeth),
        condition_indicators(average.average, teeth, healthy=healthy, resolution=resolution),
        _intervals(_by_period(turns, period), figures) if len(turns) >= FEWEST_BLOCKS else None,
    )


def _intervals(turns: Array, figures: Callable[[Array], dict[str, float]]) -> dict[str, Interval]:
    """Figures of the average of turns with their intervals."""

    def maxima(one: Array) -> dict[str, float]:
        found = figures(one)
        return {name: found[name] for name in MAXIMA}

    return jackknife(turns, figures) | bootstrap(turns, maxima)


def quantisation(samples: Array) -> float:
    """Rms of the rounding of samples to their smallest step: the step over the root of 12.

    Args:
        samples: in any unit, (n,).
    """
    steps = np.diff(np.unique(samples))
    return float(steps.min()) / math.sqrt(12.0) if len(steps) else 0.0


def _points(signal: Signal, teeth: int, ratio: float) -> int:
    """Points of the average: a multiple of the tooth number that keeps all that is resolved."""
    fastest = ratio * float(np.abs(np.diff(signal.angle)).max())
    resolved = interpolation.EXACT * math.tau / max(fastest, 1e-12)
    wanted = min(resolved / orders.EXACT, MOST_PER_TURN)
    return teeth * max(math.ceil(wanted / teeth), 2)


def _period(teeth: Teeth, gear: str, mesh: str | None) -> int:
    """Turns of a gear relative to the carrier after which the same teeth meet."""
    mates = {"sun": ("planet",), "ring": ("planet",), "planet": ("sun", "ring")}[gear]
    met = [mate for mate in mates if mesh is None or mate in mesh.split("_")]
    own = getattr(teeth, gear)
    return math.lcm(*(getattr(teeth, mate) // math.gcd(getattr(teeth, mate), own) for mate in met))


def _used(turns: Array, period: int) -> Array:
    """Turns of whole meshing periods, or all of them if there is none."""
    return turns[: len(turns) // period * period or len(turns)]


def _by_period(turns: Array, period: int) -> Array:
    """Averages over meshing periods if there are enough of them, otherwise the turns."""
    if len(turns) // period < FEWEST_BLOCKS or len(turns) % period:
        return turns
    return turns.reshape(len(turns) // period, period, -1).mean(axis=1)
