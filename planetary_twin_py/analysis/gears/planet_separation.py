"""Averages of one planet, and of the sun in its mesh, from a sensor which the planets pass.

The signal in a window around each pass of a planet is that of the teeth which are in mesh there.
Windows of many passes, put where their teeth are, sum to the average of the whole gear (McFadden
1991, J. Sound Vib. 144, 163). From pass to pass, Zr teeth go by (ring held; Zs, sun held), so
teeth at the sensor are gcd(Zr, Z) apart: Hann windows must be twice as wide to sum to a constant.
"""

from __future__ import annotations

import math
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...gearset.kinematics import Teeth
from ..shaft.orders import one_way, resampled_from
from ..spectra.spectrum import checked

Array = NDArray[np.float64]
PER_TOOTH = 16
WIDEST = 0.5  # of the distance of two planets on the ring: the widest window


class TeethSeen(NamedTuple):
    """Teeth that are in mesh when a planet passes a sensor."""

    number: int
    """Number of different teeth."""
    step: int
    """Distance of neighbouring ones [teeth]."""
    turns: int
    """Turns of the carrier after which the first one returns."""

    @property
    def window(self) -> int:
        """Least width of a Hann window that sums to a constant [teeth]."""
        return 2 * self.step


class Separated(NamedTuple):
    """Average of a gear over one turn relative to the carrier."""

    tooth: Array
    """Number of the tooth in mesh, from that at the first pass on, with fractions, (points,)."""
    average: Array
    """In the unit of the signal, (points,)."""
    passes: int
    """Number of passes that were used."""
    window: int
    """Width of the Hann windows [teeth]."""
    seen: TeethSeen
    """Teeth at the sensor."""
    cycles: Array
    """The same average of each cycle of passes that sees every tooth once, (cycles, points)."""
    first: float
    """Way of the carrier from the first sample to the first pass [rad]."""


def teeth_seen(per_turn: int, teeth: int) -> TeethSeen:
    """Teeth of a gear that a sensor sees in the passes of one planet.

    Args:
        per_turn: teeth that pass a mesh per turn of the carrier: Zr with the ring held.
        teeth: tooth number of the gear.
    """
    step = math.gcd(per_turn, teeth)
    return TeethSeen(teeth // step, step, teeth // step)


def widest_window(per_turn: int, planets: int) -> float:
    """Widest window in which the planet is nearer to the sensor than the next one [teeth].

    At the ends of the window the next planet is three times as far as this one.

    Args:
        per_turn: teeth that pass a mesh per turn of the carrier.
        planets: number of planets.
    """
    return WIDEST * per_turn / planets


def separate(
    samples: ArrayLike,
    carrier_angle: ArrayLike,
    teeth: tuple[int, int, int],
    planets: int,
    gear: Literal["sun", "planet"] = "planet",
    passing: float = 0.0,
    held: Literal["ring", "sun"] = "ring",
    window: int | None = None,
) -> Separated:
    """Average of one planet, or of the sun in its mesh, by windows (McFadden 1991).

    Args:
        samples: of a sensor on the housing at equal steps of time, in any unit, (n,).
        carrier_angle: of the carrier at the samples, continuous over turns [rad], (n,).
        teeth: tooth numbers of sun, planet and ring.
        planets: number of planets.
        gear: "planet", or "sun".
        passing: a carrier angle at which the planet is at the sensor [rad].
        held: member at rest; another choice than "ring" changes the teeth that pass.
        window: width of the Hann windows [teeth], even; default: the least that sums to a constant.

    Returns:
        The average over one turn of the gear relative to the carrier, 16 points for each tooth.
        Teeth are counted in the order in which they mesh; number 0 is in mesh with the ring (of the
        sun: with the planet) in the first pass.

    Raises:
        ValueError: see `resample_by_angle`; gear set or angle are invalid; the windows that sum to
            a constant are wider than half the distance of two planets, so the planets cannot be
            separated; or the record has fewer passes than needed to see every tooth.
    """
    if gear not in ("sun", "planet") or held not in ("ring", "sun") or gear == held:
        raise ValueError(f"gear = {gear!r}, held = {held!r}: must be a gear that turns")
    if not math.isfinite(passing):
        raise ValueError(f"passing = {passing:g}: must be an angle")
    numbers = _tooth_numbers(teeth, planets)
    count, per_turn = getattr(numbers, gear), getattr(numbers, held)
    seen = teeth_seen(per_turn, count)
    width = _window(window, seen, per_turn, planets, gear)
    turned = one_way(carrier_angle)
    values = checked(samples)
    if values.shape != turned.shape:
        raise ValueError(f"angle: {len(turned)} values for samples of shape {values.shape}")
    first = _first_pass(np.asarray(carrier_angle, dtype=np.float64), passing, width / per_turn)
    half, turn = width * PER_TOOTH // 2, per_turn * PER_TOOTH
    start = first - math.pi * width / per_turn
    resampled = resampled_from(values, turned, start, turn).samples
    passes = (len(resampled) - 2 * half - 1) // turn + 1
    if passes < seen.turns:
        raise ValueError(
            f"samples: {max(passes, 0)} passes of the planet: must be at least {seen.turns}, in "
            f"which every tooth of the {gear} is seen"
        )
    passes -= passes % seen.turns  # each tooth equally often, so that windows sum to a constant
    parts = np.lib.stride_tricks.sliding_window_view(resampled, 2 * half)[: passes * turn : turn]
    cycles = _summed(parts, turn, seen.turns, count * PER_TOOTH)
    tooth = np.arange(count * PER_TOOTH) / PER_TOOTH
    return Separated(tooth, cycles.mean(axis=0), passes, width, seen, cycles, first)


def _tooth_numbers(teeth: tuple[int, int, int], planets: int) -> Teeth:
    if len(teeth) != 3 or min(*teeth, planets) < 1:
        raise ValueError(
            f"teeth = {teeth}, planets = {planets}: must be the tooth numbers of sun, planet and "
            "ring, and a number of planets"
        )
    return Teeth(*teeth)


def _summed(parts: Array, turn: int, turns: int, points: int) -> Array:
    """Averages over a turn of the gear, of windows that are put where their teeth are.

    Args:
        parts: signal around each pass, (passes, 2 half).
        turn: points from one pass to the next.
        turns: passes in which every tooth is seen once.
        points: of a turn of the gear.

    Returns:
        Averages, (passes / turns, points).
    """
    half = parts.shape[1] // 2
    around = np.arange(-half, half)
    weights = 0.5 + 0.5 * np.cos(math.pi * around / half)
    cycles, weight = np.zeros((len(parts) // turns, points)), np.zeros(points)
    for number, part in enumerate(parts):
        at = (number * turn + around) % points
        np.add.at(cycles[number // turns], at, weights * part)
        if number < turns:
            np.add.at(weight, at, weights)
    return np.asarray(cycles / weight)


def _first_pass(angle: Array, passing: float, share: float) -> float:
    """Angle since the first sample of the first pass with a whole window before it [rad].

    Args:
        angle: of the carrier [rad], (n,).
        passing: one at which the planet is at the sensor [rad].
        share: width of a window [turns].
    """
    sense = math.copysign(1.0, angle[-1] - angle[0])
    ahead = math.fmod(sense * (passing - angle[0]), math.tau) % math.tau
    return ahead if ahead >= math.pi * share else ahead + math.tau


def _window(given: int | None, seen: TeethSeen, per_turn: int, planets: int, gear: str) -> int:
    """Width of the windows [teeth]; raises `ValueError` if it separates nothing."""
    least, most = seen.window, widest_window(per_turn, planets)
    if least > most:
        raise ValueError(
            f"gear = {gear!r}: cannot be separated: a sensor sees {seen.number} of "
            f"{seen.number * seen.step} teeth, {seen.step} apart, so windows must be {least} teeth "
            f"wide; from {most:.3g} teeth on they contain other planets"
        )
    if given is None:
        return least
    if given % least or given > most:
        raise ValueError(
            f"window = {given}: must be a multiple of {least} teeth, so that windows sum to a "
            f"constant, and at most {most:.3g}"
        )
    return given
