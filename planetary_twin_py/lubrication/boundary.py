"""Boundary friction of the asperities (Salagianni et al. 2017, eqs. (7)-(11)).

With the mean asperity pressure P_m = W_a/A_a (9), the friction f_b = (tau0 + eps P_m) A_a of
(7) and (8) is tau0 A_a + eps W_a: nothing is divided by A_a, which vanishes with lambda.
Both A_a (10) and W_a (11) are proportional to the apparent area A = 2 b L.
"""

from __future__ import annotations

from typing import NamedTuple

from .._compile import law
from .asperities import contact_area_function, contact_load_function
from .printed_asperities import printed_area_function, printed_load_function


class Asperities(NamedTuple):
    """What the rough surface contributes to boundary friction."""

    area_factor: float  # [-] A_a/(A F_2) = pi^2 (xi beta sigma)^2
    pressure_factor: float  # [Pa] W_a/(A F_5/2) = 16 sqrt2/15 pi (xi beta sigma)^2 sqrt(s/b) E*
    shear_stress: float  # [Pa] tau0 of the lubricant
    pressure_coefficient: float  # [-] eps, growth of the shear stress with asperity pressure


@law
def boundary_shear(asperities: Asperities, printed: bool, lambda_ratio: float) -> float:
    """Boundary friction per apparent area, f_b/A [Pa]; with `printed` asperity functions or not."""
    if printed:
        area = printed_area_function(lambda_ratio)
        pressure = printed_load_function(lambda_ratio)
    else:
        area = contact_area_function(lambda_ratio)
        pressure = contact_load_function(lambda_ratio)
    area *= asperities.area_factor
    pressure *= asperities.pressure_factor
    return asperities.shear_stress * area + asperities.pressure_coefficient * pressure
