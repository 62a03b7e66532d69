"""Viscosity of oil against temperature (Walther 1931; ASTM D341).

log10 log10(nu + 0.7) = A - B log10 T, nu the kinematic viscosity in mm^2/s and T the temperature
in K. The slope B is a property of the oil; A follows from one known viscosity. The density is
constant.
"""

from __future__ import annotations

import math

THICKEST = 1e9  # [mm^2/s] far below the pour point


def walther_slope(cold: tuple[float, float], hot: tuple[float, float]) -> float:
    """Slope B from two points (temperature [K], kinematic viscosity [m^2/s])."""
    rise = walther_level(cold[1]) - walther_level(hot[1])
    return rise / math.log10(hot[0] / cold[0])


def viscosity_at(
    temperature: float, reference: tuple[float, float], slope: float, density: float
) -> float:
    """Dynamic viscosity [Pa s] at `temperature` [K].

    Args:
        temperature: of the oil [K].
        reference: a temperature [K] and the dynamic viscosity there [Pa s].
        slope: B of the oil [-].
        density: of the oil [kg/m^3].
    """
    known = walther_level(reference[1] / density)
    level = known - slope * math.log10(temperature / reference[0])
    highest = math.log10(math.log10(THICKEST))
    return density * 1e-6 * (10.0 ** (10.0 ** min(level, highest)) - 0.7)


def walther_level(kinematic: float) -> float:
    """log10 log10(nu + 0.7), nu the kinematic viscosity [m^2/s] in mm^2/s."""
    return math.log10(math.log10(kinematic * 1e6 + 0.7))
