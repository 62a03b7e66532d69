"""Speed ratios of a planetary gearset (Willis 1841).

All speeds are absolute and counter-clockwise positive. Salagianni et al. 2017, eq. (1a) is
(Zr + Zs) wc = Zr wr + Zs ws; the planets follow from Zp (wp - wc) = -Zs (ws - wc).
"""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

MEMBERS = ("sun", "ring", "carrier")


class Teeth(NamedTuple):
    """Tooth numbers."""

    sun: int
    planet: int
    ring: int


def speed_ratios(teeth: Teeth, held: str, reference: str) -> dict[str, Fraction]:
    """Speed of sun, ring, carrier and planet per speed of `reference`, with `held` at rest.

    Exact fractions, so that angles can be reduced modulo a turn without error.

    Raises:
        ValueError: `held` or `reference` is no central member, or both are the same.
    """
    if held not in MEMBERS or reference not in MEMBERS or held == reference:
        raise ValueError(f"held = {held!r}, reference = {reference!r}: two of {MEMBERS} required")
    zs, zp, zr = teeth
    # Motion with the carrier at rest, plus a rotation of everything that stops `held`.
    relative = {
        "sun": Fraction(1),
        "ring": Fraction(-zs, zr),
        "carrier": Fraction(0),
        "planet": Fraction(-zs, zp),
    }
    absolute = {body: speed - relative[held] for body, speed in relative.items()}
    return {body: speed / absolute[reference] for body, speed in absolute.items()}


def mesh_cycles_per_turn(teeth: Teeth, held: str, reference: str) -> Fraction:
    """Teeth passing a mesh per turn of `reference`: Zs (ws - wc), signed.

    Corrects Salagianni et al. 2017, eq. (1e), whose last form holds for a held ring only.
    """
    ratios = speed_ratios(teeth, held, reference)
    return teeth.sun * (ratios["sun"] - ratios["carrier"])
