"""Line of action of involute flanks, in the frame of the carrier.

It passes through the pitch point, tangent to both base circles and normal to the flanks. Drive
flanks carry load while the sun drives counter-clockwise; on the sun they face counter-clockwise.
Coast flanks are the others.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

DRIVE, COAST = 1, -1


@dataclass(frozen=True)
class LineOfAction:
    """Line of action of one flank of a mesh."""

    pitch_point: tuple[float, float]
    """(x, y) [m]."""
    direction: tuple[float, float]
    """Unit vector (x, y) in which the first gear pushes the second, and in which the contact moves
    from approach to recess."""

    def at(self, position: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points of the line (x, y) [m], (..., 2).

        Args:
            position: after the pitch point [m], any shape (...).
        """
        return np.asarray(self.pitch_point) + position[..., None] * np.asarray(self.direction)


def line_of_action(
    planet_angle: float, pitch_radius: float, pressure_angle: float, flank: int, ring: bool
) -> LineOfAction:
    """Line of action of a mesh.

    Args:
        planet_angle: position of the planet [rad].
        pitch_radius: of the sun or the ring [m].
        pressure_angle: [rad].
        flank: `DRIVE` or `COAST`.
        ring: whether the mesh is that of the planet with the ring; otherwise with the sun.

    Returns:
        Pitch point [m] and direction.
    """
    out = (math.cos(planet_angle), math.sin(planet_angle))
    sideways = math.cos(pressure_angle) * flank * (-1 if ring else 1)
    outwards = math.sin(pressure_angle)
    return LineOfAction(
        (pitch_radius * out[0], pitch_radius * out[1]),
        (outwards * out[0] - sideways * out[1], outwards * out[1] + sideways * out[0]),
    )
