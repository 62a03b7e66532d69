"""Speed ratios of a planetary gearset (Willis 1841).

All speeds are absolute and positive counter-clockwise. Eq. (1a) of Salagianni et al. 2017 is
(Zr + Zs) wc = Zr wr + Zs ws; the speed of the planets follows from Zp (wp - wc) = -Zs (ws - wc).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

MEMBERS = ("sun", "ring", "carrier")


class Teeth(NamedTuple):
    """Tooth numbers of sun, planet and ring."""

    sun: int
    planet: int
    ring: int


def speed_ratios(teeth: Teeth, held: str, reference: str) -> dict[str, Fraction]:
    """Speeds of all members relative to that of a reference (Willis 1841).

    Args:
        teeth: tooth numbers.
        held: member at rest, "sun", "ring" or "carrier".
        reference: another of these.

    Returns:
        Speed of sun, ring, carrier and planet over that of `reference`. The fractions are exact, so
        angles can be reduced modulo a turn without error.

    Raises:
        ValueError: `held` or `reference` is not a central member, or they are equal.
    """
    if held not in MEMBERS or reference not in MEMBERS or held == reference:
        raise ValueError(f"held = {held!r}, reference = {reference!r}: two of {MEMBERS} required")
    zs, zp, zr = teeth
    # Motion with the carrier at rest, plus a common rotation that stops `held`.
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
    """Speeds of all members relative to that of each input, with the other input at rest.

    A gearset has one input and a held member, or is a differential with two inputs and no held
    member. The speeds of a differential are the sums over both inputs.

    Args:
        teeth: tooth numbers.
        inputs: one or two of "sun", "ring" and "carrier".
        held: member at rest; ignored for two inputs.

    Returns:
        Result of `speed_ratios` for each input.

    Raises:
        ValueError: two of the members are equal, or one is not a central member.
    """
    if len(inputs) == 1:
        return (speed_ratios(teeth, held, inputs[0]),)
    first, second = inputs
    return speed_ratios(teeth, second, first), speed_ratios(teeth, first, second)


def mesh_frequency(teeth: Teeth, sun: float, carrier: float) -> float:
    """Mesh frequency [Hz].

    Args:
        teeth: tooth numbers.
        sun: speed of the sun [rad/s].
        carrier: speed of the carrier [rad/s].
    """
    return teeth.sun * abs(sun - carrier) / (2.0 * math.pi)


def mesh_cycles_per_turn(teeth: Teeth, ratios: dict[str, Fraction]) -> Fraction:
    """Number of teeth that pass a mesh per turn of the reference: Zs (ws - wc), signed.

    It corrects Salagianni et al. 2017, eq. (1e), whose last form is valid for a held ring only.

    Args:
        teeth: tooth numbers.
        ratios: speeds relative to that of the reference, from `speed_ratios`.
    """
    return teeth.sun * (ratios["sun"] - ratios["carrier"])
