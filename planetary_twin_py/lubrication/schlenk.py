"""Mean friction coefficient of a gear mesh after Schlenk 1995 (Niemann and Winter; ISO/TR 14179-2).

mu = 0.048 (F_bt/b / (v_sum rho_red))^0.2 eta^-0.05 Ra^0.25 X_L with F_bt/b in N/mm, v_sum in m/s,
rho_red in mm, eta in mPa s and Ra in um: a regression of the losses of test gears, boundary
friction included. It is applied here to each tooth pair with its own load, speeds and radius; at
the pitch point, with the whole load on one pair, it is the printed value.
"""

from __future__ import annotations

import math

COEFFICIENT, LOAD, VISCOSITY, ROUGHNESS = 0.048, 0.2, -0.05, 0.25


def log_schlenk_factor(
    face_width: float, viscosity: float, roughness: float, oil_factor: float
) -> float:
    """Logarithm of mu at F/(V R) = 1 N s/m^2.

    Args:
        face_width: length of the contact b [m].
        viscosity: dynamic viscosity of the oil eta [Pa s].
        roughness: composite root mean square roughness sigma of both flanks [m]. The printed Ra is
            the arithmetic mean of both flanks; for equal flanks with Gaussian heights it is
            sigma/sqrt(pi).
        oil_factor: X_L [-], 1 for mineral oil.
    """
    # v_sum = 2 V; N/mm over mm m/s is 1e-6 N/m over m m/s.
    return (
        math.log(COEFFICIENT * oil_factor)
        + LOAD * math.log(1e-6 / (2.0 * face_width))
        + VISCOSITY * math.log(1e3 * viscosity)
        + ROUGHNESS * math.log(1e6 * roughness / math.sqrt(math.pi))
    )
