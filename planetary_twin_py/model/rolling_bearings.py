"""Rolling bearings of a scene for the core, and their eccentricity under a load.

Palmgren 1959, Ball and Roller Bearing Engineering: an element between both raceways yields by
7.68e-5 Q^0.9/l^0.8 (roller) or 4.36e-4 Q^(2/3)/D^(1/3) (ball), in mm, with its load Q in N, the
length l of the roller and the diameter D of the ball in mm. `core/model/rolling_bearing.hpp` has
the force of all elements together.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from .._core import RollingBearing, rolling_bearing_law
from ..scene.supports import Rolling

MILLIMETRE = 1e-3  # [m]
TERMS = 14
"""Coefficients of the load zone. Its series in e converges as e^k, e <= 1/2; interpolation at
Chebyshev points leaves less than 1e-13."""


def rolling_bearing(rolling: Rolling) -> RollingBearing:
    """Law of a rolling bearing for the core.

    Args:
        rolling: elements of the bearing.
    """
    exponent, element = element_law(rolling)
    return RollingBearing(
        strength=rolling.elements * element,
        exponent=exponent,
        load_zone=_load_zone(exponent),
        damping_time=rolling.damping_time,
    )


def element_law(rolling: Rolling) -> tuple[float, float]:
    """Exponent n, and load of an element over its deflection^n [N/m^n]."""
    if rolling.rollers is not None:
        exponent, length = 10.0 / 9.0, (rolling.length or 0.0) / MILLIMETRE
        load = 7.68e-5**-exponent * length ** (8.0 / 9.0)
    else:
        exponent, diameter = 1.5, (rolling.diameter or 0.0) / MILLIMETRE
        load = 4.36e-4**-exponent * math.sqrt(diameter)
    return exponent, load * MILLIMETRE**-exponent


@cache
def _load_zone(exponent: float) -> np.ndarray:
    """Coefficients of the load zone E(e) for 0 <= e <= 1/2, lowest first, (TERMS,)."""
    from scipy.special import beta, hyp2f1  # takes time to import

    def load_zone(e: np.ndarray) -> np.ndarray:
        scale = beta(0.5, exponent + 2.0) / (math.pi * (exponent + 1.0))
        return np.asarray(scale * hyp2f1(0.5, 0.5, exponent + 2.5, e))

    found = np.polynomial.Chebyshev.interpolate(load_zone, TERMS - 1, domain=[0.0, 0.5])
    # Rounded: special functions and matrix products have other last digits on other machines.
    return np.round(found.convert(kind=np.polynomial.Polynomial).coef, 9)


def largest_element_load(rolling: Rolling, clearance: float, size: np.ndarray) -> np.ndarray:
    """Load of the most loaded element.

    Args:
        rolling: elements of the bearing.
        clearance: radial clearance [m].
        size: eccentricities [m], any shape.

    Returns:
        The load of the element in line with the eccentricity [N], of the shape of `size`.
    """
    exponent, element = element_law(rolling)
    return np.asarray(element * np.maximum(size - clearance, 0.0) ** exponent)


def press(bearing: RollingBearing, clearance: float, size: np.ndarray) -> np.ndarray:
    """Energy, force and stiffness of a bearing along its eccentricity.

    Args:
        bearing: law of the bearing.
        clearance: radial clearance [m].
        size: eccentricities [m], (n,).

    Returns:
        Energy [J], force [N] and stiffness along the load [N/m], (3, n).
    """
    return np.asarray(rolling_bearing_law(bearing, clearance, np.ascontiguousarray(size)))


def eccentricity(bearing: RollingBearing, clearance: float, load: float) -> float:
    """Eccentricity of a bearing under a load.

    Args:
        bearing: law of the bearing.
        clearance: radial clearance [m].
        load: load on the bearing [N], above 0.

    Returns:
        The eccentricity [m].
    """
    from scipy.optimize import brentq

    def missing(size: float) -> float:
        return float(press(bearing, clearance, np.array([size]))[1, 0]) - load

    largest = 2.0 * clearance + (load / bearing.strength) ** (1.0 / bearing.exponent)
    while missing(largest) < 0.0:
        largest *= 2.0
    return float(brentq(missing, clearance, largest, xtol=1e-18, rtol=1e-14))
