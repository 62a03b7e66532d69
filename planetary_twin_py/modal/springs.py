"""A linear model as masses and springs.

Every spring is a row: it is stretched by row @ q and stores k (row @ q)^2/2, so the stiffness
matrix is the sum of k row row^T. A mesh, a bearing and a support differ in nothing but their row.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np


class Spring(NamedTuple):
    """A spring of a kind that varies together, e.g. all sun meshes."""

    kind: str
    stiffness: float  # [N/m]
    row: np.ndarray  # (coordinates,)


class SpringModel(NamedTuple):
    """Masses and springs over named coordinates, all of them lengths.

    A coordinate is named "body.motion", e.g. "planet_2.u"; rotations are arc lengths u = r theta.
    """

    coordinates: tuple[str, ...]
    mass: np.ndarray  # (coordinates,) [kg]
    springs: tuple[Spring, ...]

    @property
    def acting(self) -> tuple[Spring, ...]:
        """The springs whose stiffness is not zero."""
        return tuple(spring for spring in self.springs if spring.stiffness > 0.0)

    @property
    def stiffness(self) -> np.ndarray:
        """Stiffness matrix [N/m], shape (coordinates, coordinates)."""
        rows = np.array([spring.row for spring in self.springs])
        weights = np.array([spring.stiffness for spring in self.springs])
        return (rows.T * weights) @ rows

    def holding(self, *held: str) -> SpringModel:
        """The model with some coordinates at rest."""
        kept = np.array([name not in held for name in self.coordinates])
        return SpringModel(
            tuple(np.array(self.coordinates)[kept]),
            self.mass[kept],
            tuple(spring._replace(row=spring.row[kept]) for spring in self.springs),
        )


class Rows:
    """Builds rows by the names of coordinates.

    Args:
        coordinates: names in their order.
    """

    def __init__(self, coordinates: tuple[str, ...]) -> None:
        self._place = {name: k for k, name in enumerate(coordinates)}

    def __call__(self, parts: dict[str, float]) -> np.ndarray:
        """A row with the given entries; names that are no coordinates are at rest."""
        row = np.zeros(len(self._place))
        for name, value in parts.items():
            if name in self._place:
                row[self._place[name]] += value
        return row
