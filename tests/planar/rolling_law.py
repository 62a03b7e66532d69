"""Rolling bearings from the deflection of each element (Palmgren 1959), for tests."""

import math

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

ROLLERS, BALLS = 10.0 / 9.0, 1.5  # exponents


def element(rolling):
    """Number of elements, exponent, and load of one over its deflection^n, in SI."""
    if rolling.rollers:
        load = (1.0 / 7.68e-5) ** (1.0 / 0.9) * (1e3 * rolling.length) ** (0.8 / 0.9)
        return rolling.rollers, ROLLERS, load * 1e3**ROLLERS
    load = (1.0 / 4.36e-4) ** 1.5 * math.sqrt(1e3 * rolling.diameter)
    return rolling.balls, BALLS, load * 1e3**BALLS


def spread_force(rolling, clearance, size):
    """Force of elements that are spread evenly over the circumference."""
    count, n, load = element(rolling)
    if size <= clearance:
        return 0.0
    end = math.acos(clearance / size)

    def part(angle):
        return max(size * math.cos(angle) - clearance, 0.0) ** n * math.cos(angle)

    return count * load / math.pi * quad(part, 0.0, end, epsabs=0.0, epsrel=1e-12, limit=200)[0]


def force_of_elements(rolling, clearance, size, place=0.0):
    """Force of elements that stand at multiples of their distance, `place` of it from the load."""
    count, n, load = element(rolling)
    angles = 2.0 * math.pi * (np.arange(count) + place) / count
    deflection = np.maximum(size * np.cos(angles) - clearance, 0.0)
    return load * (deflection**n * np.cos(angles)).sum()


def size_under(force, load, clearance):
    """Eccentricity at which `force` of it is the load."""
    return brentq(lambda size: force(size) - load, clearance, 1e-3, xtol=1e-17)


def slope(force, size, step=1e-9):
    """Stiffness by differences."""
    return (force(size + step) - force(size - step)) / (2.0 * step)
