"""The straight line on which involute flanks touch, seen from the carrier.

It runs through the pitch point, tangent to both base circles, along the normal of the flanks. Drive
flanks are those that carry while the sun, turning counter-clockwise, drives: on the sun those that
face counter-clockwise. Coast flanks are the others.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

DRIVE, COAST = 1, -1


@dataclass(frozen=True)
class LineOfAction:
    """Of the flanks of one mesh: `pitch_point` [m] and unit `direction`, both (x, y).

    The direction is that in which the first gear pushes the second, and in which the contact moves
    as the tooth pair goes on from approach to recess.
    """

    pitch_point: tuple[float, float]
    direction: tuple[float, float]

    def at(self, position: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points [m] at `position` [m] past the pitch point, any shape (...); result (..., 2)."""
        return np.asarray(self.pitch_point) + position[..., None] * np.asarray(self.direction)


def line_of_action(
    planet_angle: float, pitch_radius: float, pressure_angle: float, flank: int, ring: bool
) -> LineOfAction:
    """Of a planet at `planet_angle` [rad] with the sun, or with the `ring`, on one `flank`.

    `pitch_radius` [m] is that of the sun or the ring, `flank` DRIVE or COAST.
    """
    out = (math.cos(planet_angle), math.sin(planet_angle))
    sideways = math.cos(pressure_angle) * flank * (-1 if ring else 1)
    outwards = math.sin(pressure_angle)
    return LineOfAction(
        (pitch_radius * out[0], pitch_radius * out[1]),
        (outwards * out[0] - sideways * out[1], outwards * out[1] + sideways * out[0]),
    )
