"""Orders of faults of a planet bearing, whose inner race is on the pin.

With f the speed of the planet on its pin, Z rollers and g = d/D cos(contact angle): outer race
Z f (1 - g)/2, inner race Z f (1 + g)/2, roller f (1 - g^2)/(2 g), and cage f (1 + g)/2 relative to
the carrier (Randall and Antoni 2011, Mech. Syst. Signal Process. 25, 485-520, for the rates, which
depend on the relative speed alone). The load zone is fixed in the carrier: a fault of the outer
race, in the bore of the planet, runs through it once per turn on the pin; one of the inner race
stays in it; a roller passes it with the cage. As one planet is unlike the others, every line has
sidebands of the carrier.
"""

from __future__ import annotations

from fractions import Fraction

from .fault_lines import FaultLines
from .turning import Turning


def bearing_lines(turning: Turning, rollers: int, ratio: Fraction) -> tuple[FaultLines, ...]:
    """Lines of faults of outer race, inner race and a roller.

    Args:
        turning: of the gear set.
        rollers: number of rollers.
        ratio: roller diameter over pitch diameter, times the cosine of the contact angle.

    Raises:
        ValueError: fewer than three rollers, or a ratio that is not between 0 and 1.
    """
    if rollers < 3:
        raise ValueError(f"rollers = {rollers}: must be at least 3")
    if not 0 < ratio < 1:
        raise ValueError(f"ratio = {float(ratio):g}: must be above 0 and below 1")
    pin = turning.tooth("planet")
    cage = pin * (1 + ratio) / 2
    outer, inner = rollers * pin * (1 - ratio) / 2, rollers * cage
    roller = pin * (1 - ratio**2) / (2 * ratio)
    passing = (-1, 0, 1) if turning.carrier else (0,)
    carrier = abs(turning.carrier)

    def around(rate: Fraction, zone: Fraction) -> tuple[Fraction, ...]:
        places = {rate + n * zone + m * carrier for n in (-1, 0, 1) for m in passing}
        return tuple(sorted(places))

    of_inner = around(inner, Fraction(0))
    crossing = tuple(inner + n * pin for n in (-1, 1) if inner + n * pin not in of_inner)
    return (
        FaultLines("outer race (planet)", outer, around(outer, pin), ()),
        FaultLines("inner race (pin)", inner, of_inner, crossing),
        # A roller strikes both races in a turn, so twice its rate may be the higher one.
        FaultLines("roller", roller, around(roller, cage) + around(2 * roller, cage), ()),
        FaultLines("cage", cage, around(cage, Fraction(0)), ()),
    )
