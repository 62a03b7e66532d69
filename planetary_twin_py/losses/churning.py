"""Drag of a disc that turns in a housing full of oil, or of oil and air (Daily and Nece 1960).

Torque on both sides C_m rho w^2 r^5/2, with C_m = 2 pi/(G Re), 3.7 G^0.1 Re^-0.5, 0.08 G^(-1/6)
Re^-0.25 and 0.102 G^0.1 Re^-0.2 for laminar and turbulent flow with merged and separate boundary
layers; the largest holds. Re = w r^2/nu, G the axial gap over r. J. Basic Eng. 82, 217-230.
"""

from __future__ import annotations

import math

from .._compile import kernel


@kernel
def disc_torque(
    radius: float, gap_ratio: float, density: float, kinematic_viscosity: float, speed: float
) -> float:
    """Torque [N m] on both sides of a disc, zero at rest.

    Args:
        radius: of the disc [m].
        gap_ratio: axial gap to the housing over the radius, G [-].
        density: of what it turns in [kg/m^3].
        kinematic_viscosity: of the same [m^2/s].
        speed: of the disc [rad/s], of either sign.
    """
    w, nu, g = abs(speed), kinematic_viscosity, gap_ratio
    # Each is written out, so that nothing is divided by a speed that may vanish.
    laminar_merged = math.pi * nu * w / g
    laminar = 1.85 * g**0.1 * w**1.5 * math.sqrt(nu) * radius
    turbulent_merged = 0.04 * g ** (-1.0 / 6.0) * w**1.75 * nu**0.25 * radius**1.5
    turbulent = 0.051 * g**0.1 * w**1.8 * nu**0.2 * radius**1.6
    largest = max(max(laminar_merged, laminar), max(turbulent_merged, turbulent))
    return density * radius**3 * largest
