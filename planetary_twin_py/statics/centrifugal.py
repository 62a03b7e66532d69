"""Centrifugal forces on the bodies of a planar gear set, in the frame that turns with the carrier.

On a body of mass m at r from the axis of the housing acts m Omega^2 r. Across the radius of a
planet, r is its displacement against its pin, as in `docs/model.md`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..model.layout import Layout
from ..model.planar_rows import CENTRAL


class Centrifugal(NamedTuple):
    """Forces f + S q on n coordinates q."""

    force: np.ndarray
    """Force on bodies in their places [N], (n,)."""
    softening: np.ndarray
    """Increase S of the force per displacement [N/m], (n, n)."""

    def on(self, displacement: np.ndarray) -> np.ndarray:
        """Forces on displaced bodies [N], (P, n).

        Args:
            displacement: of each coordinate [m], (P, n).
        """
        return np.asarray(self.force + displacement @ self.softening)


def centrifugal(layout: Layout) -> Centrifugal:
    """Centrifugal forces at the speeds of the operating point.

    Args:
        layout: of the scene; without `supports`, planets have `gearset.planet_mass` and stay in
            place.

    Returns:
        The forces.
    """
    scene, rows = layout.scene, layout.rows
    square = layout.speeds_at(scene.operating_point)["carrier"] ** 2
    arm, supports, identity = (
        scene.gearset.geometry.centre_distance,
        scene.supports,
        np.eye(len(rows.coordinates)),
    )
    mass = scene.gearset.planet_mass if supports is None else supports.planet.mass
    force, softening = np.zeros(len(identity)), np.zeros(identity.shape)
    for planet in layout.planets:
        outwards = rows.place(f"{planet}.xi")
        force[outwards] = mass * square * arm
        across = identity[rows.place(f"{planet}.eta")] - identity[rows.place("carrier.u")]
        for row in (identity[outwards], across):
            softening += mass * square * np.outer(row, row)
    if supports is None:
        return Centrifugal(force, np.zeros_like(softening))
    for body in CENTRAL:
        for motion in "xy":
            row = identity[rows.place(f"{body}.{motion}")]
            softening += getattr(supports, body).mass * square * np.outer(row, row)
    return Centrifugal(force, softening)
