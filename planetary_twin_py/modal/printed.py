"""Torsional eigenproblem as printed in Salagianni et al. 2017, eqs. (29)-(38).

The bodies are sun, planets, ring and carrier. Because (35) omits the coupling of the carrier, its
motion is a separate mode. Stiffness is not projected on the line of action.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .springs import Rows, Spring, SpringModel


class PrintedSet(NamedTuple):
    """Inertias J/r^2 [kg] and stiffnesses [N/m] of (33) and (35)."""

    sun: float
    planet: float
    ring: float
    carrier: float
    sun_planet: float = 2e8
    planet_ring: float = 2e8
    carrier_support: float = 8.04e8
    """Sum of k_c11i in (38); no table explains this value."""
    planets: int = 3
    """Number of planets."""


EQUATION_37 = PrintedSet(0.272, 0.1, 0.759, 1.5)
# Inertias fitted to the four frequencies of Table 5, which they give truncated to integers. That of
# the ring is neither the 0.759 kg of (37) nor the 0.779 kg of Table 4, even if rounded.
FITTED_TO_TABLE_5 = PrintedSet(0.2718, 0.0999, 0.727, 1.498)


def printed_model(data: PrintedSet) -> SpringModel:
    """Spring model of (33) and (35).

    Args:
        data: inertias and stiffnesses.

    Returns:
        Masses and springs, with the bodies in the order of (34).
    """
    planets = [f"planet_{i + 1}.u" for i in range(data.planets)]
    coordinates = ("sun.u", *planets, "ring.u", "carrier.u")
    row = Rows(coordinates)
    springs = [Spring("carrier_support", data.carrier_support, row({"carrier.u": 1.0}))]
    for planet in planets:
        springs.append(Spring("sun_planet", data.sun_planet, row({"sun.u": 1.0, planet: -1.0})))
        springs.append(Spring("planet_ring", data.planet_ring, row({planet: 1.0, "ring.u": -1.0})))
    mass = np.array([data.sun, *[data.planet] * data.planets, data.ring, data.carrier])
    return SpringModel(coordinates, mass, tuple(springs))
