"""Axes of a map of damage over torque, speed and oil temperature, and the nodes around a point."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .local_cubic import Stencil, stencil

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

# Steps of the axes. A resonance of the meshes is as wide as twice its damping ratio: at a ratio of
# 0.03 to 0.05, a cubic over steps of 0.04 leaves some per cent at its top, and 0.4 % on average.
TORQUE_STEP = 0.25  # of log torque
SPEED_STEP = 0.04  # of log speed
HEAT_STEP = 20.0  # [K]
LIGHTEST = 0.05  # share of the largest torque from which on there are nodes
ROUNDING = 1e-9  # relative, of values at the limit of a map
QUADRANTS = [(torque, speed) for torque in (1.0, -1.0) for speed in (1.0, -1.0)]
"""Signs of torque and speed of each part of the table."""


class MapRange(NamedTuple):
    """What a map covers; magnitudes of torque and speed, of either sign."""

    torque: float
    """Largest input torque [N m]."""
    speed: tuple[float, float]
    """Lowest speed with nodes, below which damage per turn is the same, and highest [rad/s]."""
    temperature: tuple[float, float]
    """Lowest and highest oil temperature [K]."""


class Node(NamedTuple):
    """An operating point of the table."""

    quadrant: int
    heat: int
    speed: int
    torque: int


class MapAxes:
    """Nodes of a table over sign, temperature, speed and torque.

    Args:
        covered: range of the table.
    """

    def __init__(self, covered: MapRange) -> None:
        low, high = covered.speed
        self._torques = _logarithmic(LIGHTEST * covered.torque, covered.torque, TORQUE_STEP)
        self._speeds = _logarithmic(low, high, SPEED_STEP)
        self._heat = _linear(*covered.temperature, HEAT_STEP)
        self.shape = len(QUADRANTS), len(self._heat), len(self._speeds), len(self._torques)
        """Number of nodes along each axis."""

    def at(self, node: Node) -> dict[str, float]:
        """The operating point of a node, by the names of its quantities."""
        torque_sign, speed_sign = QUADRANTS[node.quadrant]
        return {
            "input_torque": torque_sign * math.exp(self._torques[node.torque]),
            "input_speed": speed_sign * math.exp(self._speeds[node.speed]),
            "oil_temperature": float(self._heat[node.heat]),
        }

    def around(self, torque: Array, speed: Array, temperature: Array) -> Surroundings:
        """The nodes around points, (n,) each, with torque and rotation."""
        quadrant = 2 * (torque < 0.0).astype(np.int64) + (speed < 0.0)
        turning = np.clip(np.log(np.abs(speed)), self._speeds[0], self._speeds[-1])
        heat = np.clip(temperature, self._heat[0], self._heat[-1])
        loads = np.minimum(np.log(np.abs(torque)), self._torques[-1])
        return Surroundings(
            quadrant,
            stencil(self._heat, heat),
            stencil(self._speeds, turning),
            stencil(self._torques, loads),
        )


class Surroundings(NamedTuple):
    """Nodes around points, and their weights."""

    quadrant: Indices
    """(n,)."""
    heat: Stencil
    speeds: Stencil
    torques: Stencil

    def mark(self, table: NDArray[np.bool_]) -> None:
        """Set a table, (quadrants, heat, speeds, torques), to True at the nodes."""
        table[
            self.quadrant[:, None, None, None],
            self.heat.nodes[:, :, None, None],
            self.speeds.nodes[:, None, :, None],
            self.torques.nodes[:, None, None, :],
        ] = True

    def corners(self) -> Iterator[tuple[tuple[Indices, ...], Array, Array]]:
        """Nodes around the points with their weights, cubic and linear."""
        heat, speeds, torques = self[1:]
        for k in range(heat.nodes.shape[1]):
            for m in range(speeds.nodes.shape[1]):
                for n in range(torques.nodes.shape[1]):
                    yield (
                        (self.quadrant, heat.nodes[:, k], speeds.nodes[:, m], torques.nodes[:, n]),
                        heat.weights[:, k] * speeds.weights[:, m] * torques.weights[:, n],
                        heat.linear[:, k] * speeds.linear[:, m] * torques.linear[:, n],
                    )


def _logarithmic(low: float, high: float, step: float) -> Array:
    """Logarithms of an axis, its ends included."""
    return _linear(math.log(low), math.log(high), step)


def _linear(low: float, high: float, step: float) -> Array:
    return np.linspace(low, high, math.ceil((high - low) / step - ROUNDING) + 1)
