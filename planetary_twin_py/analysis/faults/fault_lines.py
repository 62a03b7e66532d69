"""Where a fault of a tooth has lines in the signal of a sensor on the housing, and where not.

A mesh of planet i with a faulty gear is a function of the angle of the gear relative to the carrier
less that of the planet, so it has lines q per relative turn; planets pass the sensor, which weighs
them by a window with lines m per turn of the carrier. Summed over planets that divide a turn into K
equal parts, q (f - f_c) - m f_c remains where K divides q + m: lines at q f - k K f_c. Faults of a
planet are at one planet: all n f_m/Zp + m f_c remain. The planets share a torque that is given, so
what one of them loses, the others carry, and the sensor receives differences from the mean of all
forces: of any planets, the lines with m = 0 nearly vanish, and of N equally spaced ones those whose
m is divisible by N. Feng and Zuo 2012, J. Sound Vib. 331, 4919-4939 have the lines with m = -1, 0
and 1.
"""

from __future__ import annotations

import cmath
from fractions import Fraction
from typing import NamedTuple

from .turning import Turning

BESIDE = (-2, -1, 1, 2)
"""Sidebands of the gear that are listed around a mesh harmonic."""
NEAR = 2
"""Largest m of a listed line of sun and ring, unless the first is further."""
WEAK = 0.05
"""Sum over the planets, over that of planets in phase, up to which lines are weak."""
FAR = 6
"""Largest m at which a line may be, so that its place is not forbidden."""


class FaultLines(NamedTuple):
    """Lines of a fault around a mesh harmonic."""

    fault: str
    """Gear with the fault, or part of a bearing."""
    rate: Fraction
    """Events of one tooth in one mesh, or of a bearing, per turn of the reference."""
    present: tuple[Fraction, ...]
    """Orders at which lines must appear if the fault is seen at all."""
    absent: tuple[Fraction, ...]
    """Orders at which this fault has no line, where other faults may have one."""
    weak: tuple[Fraction, ...] = ()
    """Orders at which its lines nearly vanish, because the planets share the torque."""


def central_gear_lines(
    turning: Turning, gear: str, harmonic: int = 1, beside: tuple[int, ...] = BESIDE
) -> FaultLines:
    """Lines of a fault of the sun or of the ring.

    Args:
        turning: of the gear set.
        gear: "sun" or "ring".
        harmonic: of the mesh.
        beside: sidebands of the gear.
    """
    speed = abs(getattr(turning, gear) - turning.carrier)
    teeth = harmonic * getattr(turning.teeth, gear)
    present, weak = set[Fraction](), set[Fraction]()
    for q in (teeth + n for n in beside):
        if not turning.carrier:
            # A sensor that is nearer to one planet sees every q, any other every K-th.
            differ = 1.0 - abs(turning.added(q)) ** 2
            (present if differ > WEAK else weak).add(q * speed)
            continue
        for m in _nearest(turning, q):
            (present if _weight(turning, q, m) > WEAK else weak).add(_place(turning, gear, q, m))
    absent = set[Fraction]()
    if turning.carrier:
        absent = {_place(turning, gear, teeth + n, m) for n in beside for m in (-1, 0, 1)}
        absent -= possible_lines(turning, gear, harmonic)
    return _lines(gear, turning.tooth(gear), present, absent, weak)


def planet_lines(
    turning: Turning, harmonic: int = 1, beside: tuple[int, ...] = BESIDE
) -> FaultLines:
    """Lines of a fault of one planet.

    Args:
        turning: of the gear set.
        harmonic: of the mesh.
        beside: sidebands of the gear.
    """
    rate, carrier = turning.tooth("planet"), abs(turning.carrier)
    centres = [(harmonic * turning.teeth.planet + n) * rate for n in beside]
    if not carrier:
        return _lines("planet", rate, set(centres), set(), set())
    present, weak = set[Fraction](), set[Fraction]()
    for m in (-1, 0, 1):
        shifted = {centre + m * carrier for centre in centres}
        mean = turning.added(m)
        apart = max(abs(cmath.exp(-1j * m * place) - mean) for place in turning.places)
        (present if apart > WEAK else weak).update(shifted)
    return _lines("planet", rate, present, set(), weak)


def _lines(
    fault: str, rate: Fraction, present: set[Fraction], absent: set[Fraction], weak: set[Fraction]
) -> FaultLines:
    weak = weak - present
    return FaultLines(
        fault, rate, *(tuple(sorted(each)) for each in (present, absent - weak, weak))
    )


def _weight(turning: Turning, q: int, m: int) -> float:
    """Weight of window m for forces with q lines per turn, less their mean over the planets."""
    return abs(turning.added(q + m) - turning.added(q) * turning.added(m))


def possible_lines(turning: Turning, gear: str, harmonic: int = 1, far: int = FAR) -> set[Fraction]:
    """All orders at which a fault may have lines, also far ones.

    Args:
        turning: of the gear set.
        gear: "sun", "planet" or "ring".
        harmonic: of the mesh, beyond which they reach to the next one.
        far: largest m.
    """
    rate, most = turning.tooth(gear), (harmonic + 1) * getattr(turning.teeth, gear)
    if not turning.carrier:
        return {q * rate for q in range(1, most)}
    shifts = range(-far, far + 1)
    if gear == "planet":
        return {q * rate + m * abs(turning.carrier) for q in range(1, most) for m in shifts}
    return {
        _place(turning, gear, q, m)
        for q in range(1, most)
        for m in shifts
        if (q + m) % turning.symmetry == 0
    }


def _place(turning: Turning, gear: str, q: int, m: int) -> Fraction:
    """Order of a line: the gear turns q times, and the window m times."""
    speed: Fraction = getattr(turning, gear)
    return abs(q * speed - (q + m) * turning.carrier)


def _nearest(turning: Turning, q: int) -> list[int]:
    """Lines m of the window, up to `NEAR` or else the first, with which q has a line."""
    parts = turning.symmetry
    allowed = [m for m in range(-parts, parts + 1) if (q + m) % parts == 0]
    least = min(abs(m) for m in allowed)
    return [m for m in allowed if abs(m) <= max(NEAR, least)]
