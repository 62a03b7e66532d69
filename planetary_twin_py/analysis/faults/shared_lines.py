"""Faults whose lines are at the same places, so that places alone do not separate them."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations
from typing import NamedTuple

from .fault_lines import FaultLines, possible_lines
from .turning import Turning


class SharedLines(NamedTuple):
    """Places around the first mesh harmonic at which two faults may have lines."""

    first: str
    second: str
    shared: tuple[Fraction, ...]
    """Orders at which one has a line and the other may have one."""
    first_only: tuple[Fraction, ...]
    """Orders of lines of the first at which the second has none."""
    second_only: tuple[Fraction, ...]
    """Orders of lines of the second at which the first has none."""


def shared_lines(turning: Turning, faults: list[FaultLines]) -> tuple[SharedLines, ...]:
    """Pairs of faults of gears which share lines.

    Args:
        turning: of the gear set.
        faults: of sun, planet and ring.
    """
    possible = {fault.fault: possible_lines(turning, fault.fault) for fault in faults}
    pairs = (_pair(one, other, possible) for one, other in combinations(faults, 2))
    return tuple(pair for pair in pairs if pair.shared and not _trivial(turning, pair))


def _trivial(turning: Turning, pair: SharedLines) -> bool:
    """Whether one gear is at rest, so that its lines are those of the passing planets."""
    first_at_rest, second_at_rest = (
        not getattr(turning, fault) for fault in (pair.first, pair.second)
    )
    own = (pair.second_only if first_at_rest else ()) or (pair.first_only if second_at_rest else ())
    return (first_at_rest or second_at_rest) and bool(own)


def _pair(one: FaultLines, other: FaultLines, possible: dict[str, set[Fraction]]) -> SharedLines:
    first, second = set(one.present), set(other.present)
    first_only, second_only = first - possible[other.fault], second - possible[one.fault]
    parts = ((first | second) - first_only - second_only, first_only, second_only)
    return SharedLines(one.fault, other.fault, *(tuple(sorted(part)) for part in parts))
