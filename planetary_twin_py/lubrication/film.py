"""Elastohydrodynamic film thickness of a line contact.

Every law here is h = C R U^a G^b W^c with the groups of Dowson and Higginson,
U = eta0 V/(E' R), G = alpha E', W = F/(E' R L), E' = 2 E*, V the mean surface speed.
"""

from __future__ import annotations

from typing import NamedTuple

from .._compile import law
from .._vector_math import exp, log

THINNEST_FILM = 1e-9  # [m] a molecule or two of oil: keeps h positive where nothing is entrained
SLOWEST_SPEED = 1e-3  # [m/s] below it entrainment and the sense of sliding fade out


class FilmLaw(NamedTuple):
    """Coefficient and exponents of one film law."""

    coefficient: float
    speed: float
    material: float
    load: float


FILM_LAWS = {
    # Dowson, Higginson, Elastohydrodynamic Lubrication, 1977: minimum film.
    "dowson_higginson": FilmLaw(2.65, 0.70, 0.54, -0.13),
    # Dowson, Toyoda 1979: central film.
    "dowson_toyoda": FilmLaw(3.06, 0.69, 0.56, -0.10),
    # Salagianni et al. 2017, eq. (15): 2.5 R (V eta0 alpha/R)^0.7 (alpha E')^0.1 / (alpha p)^0.26
    # with the mean pressure p = F/(2 L b). As alpha p = (pi/4) G sqrt(W/(2 pi)), its exponents
    # are those of Dowson and Higginson: U^0.7 G^(0.7+0.1-0.26) W^-0.13, and its coefficient is
    # 2.5 (4/pi)^0.26 (2 pi)^0.13.
    "salagianni": FilmLaw(
        2.5 * (4.0 / 3.141592653589793) ** 0.26 * (2.0 * 3.141592653589793) ** 0.13,
        0.70,
        0.54,
        -0.13,
    ),
}


@law
def film_thickness(
    law: FilmLaw,
    radius: float,
    speed_group: float,
    material_group: float,
    load_group: float,
) -> float:
    """Film thickness h [m] from the reduced radius [m] and the groups U, G and W [-]."""
    h = law.coefficient * radius * exp(
        law.speed * log(speed_group)
        + law.material * log(material_group)
        + law.load * log(load_group)
    )
    return max(h, THINNEST_FILM)
