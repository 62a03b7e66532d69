"""Elastohydrodynamic film thickness of a line contact.

Every law has the form h = C R U^a G^b W^c with the groups of Dowson and Higginson,
U = eta0 V/(E' R), G = alpha E', W = F/(E' R L), E' = 2 E*, V the mean surface speed.
"""

from __future__ import annotations

import math

from .._core import Film


def _law(log_coefficient: float, speed: float, material: float, load: float) -> Film:
    return Film(log_coefficient=log_coefficient, speed=speed, material=material, load=load)


FILM_LAWS = {
    # Dowson, Higginson, Elastohydrodynamic Lubrication, 1977: minimum film.
    "dowson_higginson": _law(math.log(2.65), 0.70, 0.54, -0.13),
    # Dowson, Toyoda 1979: central film.
    "dowson_toyoda": _law(math.log(3.06), 0.69, 0.56, -0.10),
    # Salagianni et al. 2017, eq. (15): 2.5 R (V eta0 alpha/R)^0.7 (alpha E')^0.1 / (alpha p)^0.26
    # with the mean pressure p = F/(2 L b). As alpha p = (pi/4) G sqrt(W/(2 pi)), its exponents
    # are those of Dowson and Higginson: U^0.7 G^(0.7+0.1-0.26) W^-0.13, and its coefficient is
    # 2.5 (4/pi)^0.26 (2 pi)^0.13.
    "salagianni": _law(
        math.log(2.5) + 0.26 * math.log(4.0 / math.pi) + 0.13 * math.log(2.0 * math.pi),
        0.70,
        0.54,
        -0.13,
    ),
}
