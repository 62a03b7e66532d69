"""A linear model of masses and springs.

A spring is given by a row: its deformation is row @ q and its energy k (row @ q)^2/2, so the
stiffness matrix is the sum of k row row^T. Meshes, bearings and supports differ only in their rows.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np


class Spring(NamedTuple):
    """A spring."""

    kind: str
    """Name that springs with a common stiffness share, but for `factor`, e.g. all sun-planet
    meshes."""
    stiffness: float
    """[N/m]"""
    row: np.ndarray
    """Deformation per displacement of each coordinate, (coordinates,)."""
    factor: float = 1.0
    """Stiffness over the common stiffness of its kind."""


class SpringModel(NamedTuple):
    """Masses and springs over named coordinates, all of which are lengths."""

    coordinates: tuple[str, ...]
    """Names "body.motion", e.g. "planet_2.u"; rotations are arc lengths u = r theta."""
    mass: np.ndarray
    """[kg], (coordinates,)."""
    springs: tuple[Spring, ...]

    @property
    def acting(self) -> tuple[Spring, ...]:
        """Springs with a stiffness above zero."""
        return tuple(spring for spring in self.springs if spring.stiffness > 0.0)

    @property
    def stiffness(self) -> np.ndarray:
        """Stiffness matrix [N/m], shape (coordinates, coordinates)."""
        rows = np.array([spring.row for spring in self.springs])
        weights = np.array([spring.stiffness for spring in self.springs])
        return (rows.T * weights) @ rows

    def holding(self, *held: str) -> SpringModel:
        """The model with some coordinates at rest.

        Returns:
            The model without these coordinates.
        """
        free = np.array([name not in held for name in self.coordinates])
        return SpringModel(
            tuple(np.array(self.coordinates)[free]),
            self.mass[free],
            tuple(spring._replace(row=spring.row[free]) for spring in self.springs),
        )


class Rows:
    """Builder of rows from names of coordinates."""

    def __init__(self, coordinates: tuple[str, ...]) -> None:
        self._place = {name: k for k, name in enumerate(coordinates)}

    def __call__(self, parts: dict[str, float]) -> np.ndarray:
        """Build a row.

        Args:
            parts: entries by name of the coordinate; unknown names are at rest and ignored.

        Returns:
            The row, (coordinates,).
        """
        row = np.zeros(len(self._place))
        for name, value in parts.items():
            if name in self._place:
                row[self._place[name]] += value
        return row
