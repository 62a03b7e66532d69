"""Mesh phases, and the positions at which planets can be assembled.

The mesh phase is the delay after the sun-planet mesh of planet 1, in mesh cycles (Parker and Lin
2004). For a planet at the angle psi from planet 1 it is Zs psi/2pi at the sun and -Zr psi/2pi at
the ring.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache

from .clearance import Size, are_clear
from .kinematics import Teeth

EXACT = 1e-6  # of the spacing between two assembly positions: closer ones are these positions
# Of angles from planet 1: two angles that are rounded to 0.01 deg are 0.01 deg apart at most.
ASSEMBLY_TOLERANCE = math.radians(0.0101)


def least_mesh_angle(teeth: Teeth) -> float:
    """Spacing of the positions at which a planet can be assembled, 2 pi/(Zs + Zr) [rad].

    Args:
        teeth: tooth numbers.
    """
    return 2.0 * math.pi / (teeth.sun + teeth.ring)


def nearest_assembly(teeth: Teeth, angles: Sequence[float]) -> tuple[float, ...]:
    """Nearest positions at which planets can be assembled [rad], (planets,).

    Args:
        teeth: tooth numbers.
        angles: wanted positions of the planets [rad], (planets,).
    """
    step = least_mesh_angle(teeth)
    return tuple(angles[0] + step * place for place in _places(teeth, angles))


def assembled(teeth: Teeth, angles: Sequence[float]) -> tuple[float, ...]:
    """Positions of planets that pass `check_assembly` without the rounding of their angles.

    Args:
        teeth: tooth numbers.
        angles: given positions of the planets [rad], (planets,).

    Returns:
        The given positions, or the nearest ones if the given ones are rounded [rad], (planets,).
    """
    fitting = nearest_assembly(teeth, angles)
    largest = EXACT * least_mesh_angle(teeth)
    rounded = any(abs(a - b) > largest for a, b in zip(angles, fitting, strict=True))
    return fitting if rounded else tuple(angles)


def _places(teeth: Teeth, angles: Sequence[float]) -> list[int]:
    """Number of assembly positions from the first planet to each planet."""
    return [round((angle - angles[0]) / least_mesh_angle(teeth)) for angle in angles]


def check_assembly(
    teeth: Teeth, angles: Sequence[float], addendum: float = 1.0, size: Size | None = None
) -> None:
    """Check that the teeth of all planets mesh with sun and ring.

    Args:
        teeth: tooth numbers.
        angles: positions of the planets [rad].
        addendum: [modules], of gears without profile shift.
        size: dimensions of other gears.

    Raises:
        ValueError: a planet cannot be assembled. The message suggests the nearest positions,
            unless the planets would touch each other there.
    """
    fitting = nearest_assembly(teeth, angles)
    step = least_mesh_angle(teeth)
    miss = max(abs(a - b) for a, b in zip(angles, fitting, strict=True))
    if miss > min(ASSEMBLY_TOLERANCE, 0.25 * step):
        advice = f"nearest: {_degrees(fitting)}"
        if not are_clear(size or Size(teeth, 1.0, addendum), fitting):
            advice = "at the nearest possible angles, planets touch each other"
        raise ValueError(
            f"planets at {_degrees(angles)} cannot be assembled with "
            f"{teeth.sun}/{teeth.planet}/{teeth.ring} teeth; {advice}"
        )


def _degrees(angles: Sequence[float]) -> str:
    """Angles with the fewest decimals that leave no doubt whether they pass `check_assembly`."""
    # A position is relative to that of planet 1, which is rounded, too.
    largest = math.degrees(0.25 * ASSEMBLY_TOLERANCE)
    return f"{', '.join(_shortest(math.degrees(angle), largest) for angle in angles)} deg"


def _shortest(value: float, largest_error: float) -> str:
    """Shortest decimal number within an error of `value`, without trailing zeros."""
    texts = (f"{value:.{decimals}f}" for decimals in range(17))
    text = next((t for t in texts if abs(float(t) - value) <= largest_error), repr(value))
    return "0" if float(text) == 0.0 else text


def mesh_phases(
    teeth: Teeth, angles: Sequence[float], leads: tuple[float, float] = (0.5, 0.5)
) -> tuple[list[Fraction], list[Fraction]]:
    """Phases of the meshes (Parker and Lin 2004).

    Integer parts count teeth: tooth n of the sun, or of the ring, is at planet i after n + phase
    cycles. Between the pitch points of the two meshes of one planet, there is a phase of half a
    cycle if it has an even number of teeth, otherwise zero. To this, thicker teeth add half the
    difference of their leads, because a planet touches sun and ring with opposite flanks (Parker
    and Lin 2004, eq. 5, gamma_rs of unequal thickness).

    Args:
        teeth: tooth numbers.
        angles: positions of the planets [rad], which pass `check_assembly`.
        leads: `WorkingMesh.coast_lead` of both meshes [cycles].

    Returns:
        Phases of the sun-planet meshes and of the planet-ring meshes [cycles], (planets,) each,
        exact.
    """
    sun, ring = _exact_phases(Teeth(*teeth), tuple(angles), leads)
    return list(sun), list(ring)


@lru_cache(maxsize=64)  # fractions are slow, and the building of a train asks many times
def _exact_phases(
    teeth: Teeth, angles: tuple[float, ...], leads: tuple[float, float]
) -> tuple[tuple[Fraction, ...], tuple[Fraction, ...]]:
    offset = Fraction(1 - teeth.planet % 2, 2) + (Fraction(leads[0]) - Fraction(leads[1])) / 2
    turns = [Fraction(place, teeth.sun + teeth.ring) for place in _places(teeth, angles)]
    sun = tuple(teeth.sun * turn for turn in turns)
    return sun, tuple(offset - teeth.ring * turn for turn in turns)
