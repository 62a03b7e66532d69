"""Lines of a gearbox so close to a named one that a record does not separate both.

The main lobe of a Hann window is four bins wide (Harris 1978, Proc. IEEE 66, 51-83): of two lines
within it, only one may be seen, with an amplitude between the difference and the sum of both.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from .shaft_lines import ShaftLine, shaft_text
from .sidebands import Sideband, sideband_text

SAME = 1e-9  # [mesh orders] distance of places that no record separates

Places = Mapping[Sideband | ShaftLine, float]


class Overlap(NamedTuple):
    """Two lines that a record does not separate."""

    named: str
    """One that the name of a line states."""
    other: str
    """The other, which the name may state as well."""
    apart: float
    """Their distance [mesh orders]."""


def overlap(named: Sequence[Sideband | ShaftLine], near: Places, least: float) -> Overlap | None:
    """The closest line that overlaps one of those in a name; None if the record separates them.

    Args:
        named: what the name of a line states.
        near: places of all lines of the gearbox that may be near [mesh orders].
        least: distance from which on lines are separate [mesh orders].
    """
    pairs = [
        (abs(near[one] - near[other]), one, other)
        for one in named
        for other in near
        if one.member != other.member and SAME < abs(near[one] - near[other]) < least
    ]
    if not pairs:
        return None
    apart, one, other = min(pairs, key=lambda pair: pair[0])
    return Overlap(_text(near, near[one]), _text(near, near[other]), apart)


def _text(near: Places, place: float) -> str:
    """Description of all lines at one place."""
    there = [one for one, orders in near.items() if abs(orders - place) <= SAME]
    shafts = shaft_text([one for one in there if isinstance(one, ShaftLine)])
    sidebands = sideband_text([one for one in there if isinstance(one, Sideband)])
    return " or ".join(text for text in (shafts, sidebands) if text)
