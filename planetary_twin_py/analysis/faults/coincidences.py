"""Faults whose orders coincide, or are so close that only a long record separates them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from itertools import combinations
from typing import NamedTuple

from ..lines.sidebands import RESOLVED
from .turning import Turning

CLOSE = Fraction(1, 20)
"""Relative distance of two orders up to which they are listed as close."""


class Coincidence(NamedTuple):
    """Two faults, or a fault and the passing planets, at one order or at two that are close."""

    first: str
    second: str
    order: Fraction
    """Of the first."""
    apart: Fraction
    """Distance of both; 0 if they coincide."""

    @property
    def with_carrier(self) -> bool:
        """Whether the second is a multiple of the carrier's order, not a fault."""
        return self.second.endswith("carrier")

    @property
    def turns(self) -> float | None:
        """Turns of the reference that separate them, or None if no record does.

        The main lobe of a Hann window is four bins wide (Harris 1978, Proc. IEEE 66, 51-83).
        """
        return RESOLVED / float(self.apart) if self.apart else None


def coincidences(turning: Turning) -> tuple[Coincidence, ...]:
    """What coincides among faults of sun, planet and ring, and multiples of the carrier's order.

    A tooth of the sun or of the ring is in mesh with all planets one after the other, and one of a
    planet with sun and ring. With the ring held, its faults are at the orders of the carrier.

    Args:
        turning: of the gear set.
    """
    return tuple(_of(turning))


def _of(turning: Turning) -> Iterator[Coincidence]:
    groups = {gear: _rates(turning, gear) for gear in ("sun", "planet", "ring")}
    if turning.tooth("ring") == abs(turning.carrier):
        del groups["ring"]  # in every gear set whose ring is held
    for first, second in combinations(groups, 2):
        for one, x in groups[first].items():
            for other, y in groups[second].items():
                yield from _compared(one, x, other, y)
    carrier = abs(turning.carrier)
    for group in groups.values() if carrier else ():
        one, x = next(iter(group.items()))
        if multiple := round(x / carrier):
            yield from _compared(one, x, f"{multiple} x carrier", multiple * carrier)


def _rates(turning: Turning, gear: str) -> Mapping[str, Fraction]:
    """Rates of a tooth in one mesh and in all of them."""
    rate = turning.tooth(gear)
    if gear == "planet":
        return {"planet tooth": rate, "2 x planet tooth": 2 * rate}
    return {f"{gear} tooth": rate, f"{turning.planets} x {gear} tooth": turning.planets * rate}


def _compared(one: str, x: Fraction, other: str, y: Fraction) -> Iterator[Coincidence]:
    if abs(x - y) <= CLOSE * min(x, y):
        yield Coincidence(one, other, x, abs(x - y))
