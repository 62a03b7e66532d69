"""Rows of a planar gear set: the deformation of its springs per displacement of its bodies.

Sun, ring and carrier have displacements x and y, a planet xi (outwards) and eta (across, counter-
clockwise) from its nominal position on the carrier; every body has u = r theta, with r its base
radius, for the carrier the radius of the planet centres. These are the coordinates of Lin and
Parker 1999.

A mesh has two rows. The tangential row T q is the transmission error; the radial row R q is the
common approach of the flanks on both sides. Drive flanks approach by T q + R q, coast flanks by
-T q + R q. T + R is the row of Lin and Parker 1999, eq. (3).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

CENTRAL = ("sun", "ring", "carrier")
DRIVE, COAST = 1.0, -1.0


class PlanarRows(NamedTuple):
    """Rows of all meshes and planet bearings."""

    coordinates: tuple[str, ...]
    """Names, e.g. "sun.x" or "planet_2.eta"."""
    tangential: np.ndarray
    """Row T of each mesh, those of all planets with the sun first, (meshes, coordinates)."""
    radial: np.ndarray
    """Row R of each mesh, (meshes, coordinates)."""
    pin: np.ndarray
    """Displacement of each planet against its pin, radial and tangential, (planets, 2,
    coordinates)."""

    def flanks(self, side: float) -> np.ndarray:
        """Approach of the flanks on one side.

        Args:
            side: `DRIVE` or `COAST`.

        Returns:
            A row for each mesh, (meshes, coordinates).
        """
        return side * self.tangential + self.radial

    def place(self, name: str) -> int:
        """Index of a coordinate."""
        return self.coordinates.index(name)


def planar_coordinates(planets: int) -> tuple[str, ...]:
    """Names of the coordinates of a gear set.

    Returns:
        3 (planets + 3) names, those of sun, ring and carrier first.
    """
    central = [f"{body}.{motion}" for body in CENTRAL for motion in ("x", "y", "u")]
    return (
        *central,
        *(f"planet_{i + 1}.{motion}" for i in range(planets) for motion in ("xi", "eta", "u")),
    )


def planar_rows(planet_angles: Sequence[float], sun_angle: float, ring_angle: float) -> PlanarRows:
    """Rows of a gear set.

    Args:
        planet_angles: positions of the planets [rad], (planets,).
        sun_angle: working pressure angle of the sun-planet meshes [rad].
        ring_angle: working pressure angle of the planet-ring meshes [rad].
    """
    count = len(planet_angles)
    coordinates = planar_coordinates(count)
    place = {name: k for k, name in enumerate(coordinates)}
    tangential = np.zeros((2 * count, len(coordinates)))
    radial, pin = np.zeros_like(tangential), np.zeros((count, 2, len(coordinates)))
    for i, psi in enumerate(planet_angles):
        planet = f"planet_{i + 1}"
        for gear, angle, mesh in (("sun", sun_angle, i), ("ring", ring_angle, count + i)):
            outer = gear == "ring"
            cosine, sine = math.cos(angle), math.sin(angle) * (-1.0 if outer else 1.0)
            across = {f"{gear}.x": -cosine * math.sin(psi), f"{gear}.y": cosine * math.cos(psi)}
            across |= {f"{gear}.u": 1.0, f"{planet}.eta": -cosine}
            across |= {f"{planet}.u": -1.0 if outer else 1.0}
            along = {f"{gear}.x": sine * math.cos(psi), f"{gear}.y": sine * math.sin(psi)}
            along |= {f"{planet}.xi": -sine}
            _fill(tangential[mesh], place, across)
            _fill(radial[mesh], place, along)
        outwards = {f"{planet}.xi": 1.0, "carrier.x": -math.cos(psi), "carrier.y": -math.sin(psi)}
        sideways = {f"{planet}.eta": 1.0, "carrier.x": math.sin(psi), "carrier.y": -math.cos(psi)}
        _fill(pin[i, 0], place, outwards)
        _fill(pin[i, 1], place, sideways | {"carrier.u": -1.0})
    return PlanarRows(coordinates, tangential, radial, pin)


def _fill(row: np.ndarray, place: dict[str, int], parts: dict[str, float]) -> None:
    for name, value in parts.items():
        row[place[name]] = value
