"""Speed ratios of a planetary gearset (Willis 1841).

All speeds are absolute and counter-clockwise positive. Salagianni et al. 2017, eq. (1a) is
(Zr + Zs) wc = Zr wr + Zs ws; the planets follow from Zp (wp - wc) = -Zs (ws - wc).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
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


def speeds_per_input(
    teeth: Teeth, inputs: Sequence[str], held: str
) -> tuple[dict[str, Fraction], ...]:
    """Speeds per speed of each of the `inputs`, while the other input is at rest.

    One input with one member held, or two inputs with none held (a differential): all speeds are
    then the sum of what both inputs give.

    Raises:
        ValueError: a member is named twice or is no central member.
    """
    if len(inputs) == 1:
        return (speed_ratios(teeth, held, inputs[0]),)
    first, second = inputs
    return speed_ratios(teeth, second, first), speed_ratios(teeth, first, second)


def mesh_frequency(teeth: Teeth, sun: float, carrier: float) -> float:
    """Rate [Hz] at which teeth pass a mesh at these speeds [rad/s]."""
    return teeth.sun * abs(sun - carrier) / (2.0 * math.pi)


def mesh_cycles_per_turn(teeth: Teeth, ratios: dict[str, Fraction]) -> Fraction:
    """Teeth passing a mesh per turn of what `ratios` refer to: Zs (ws - wc), signed.

    Corrects Salagianni et al. 2017, eq. (1e), whose last form holds for a held ring only.
    """
    return teeth.sun * (ratios["sun"] - ratios["carrier"])
