"""Damage of the parts of a gearbox over torque, speed and oil temperature: a table of runs."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..scene import Scene

Array = NDArray[np.float64]


class MapRange(NamedTuple):
    """What a map covers; magnitudes of torque and speed, of either sign."""

    torque: float
    """Largest input torque [N m]."""
    speed: tuple[float, float]
    """Lowest and highest input speed with vibration [rad/s]; below, damage per turn is the same."""
    temperature: tuple[float, float]
    """Lowest and highest oil temperature [K]."""


class DamageMap:
    """Rates of damage, interpolated in a table whose points are computed when they are needed."""

    parts: tuple[str, ...]
    """Names, see `durability.parts`."""
    range: MapRange

    def outside(
        self, torque: ArrayLike, speed: ArrayLike, temperature: ArrayLike
    ) -> NDArray[np.bool_]:
        """Whether the map does not cover an operating point, (...); arguments as of `rates`."""
        raise NotImplementedError

    def rates(self, torque: ArrayLike, speed: ArrayLike, temperature: ArrayLike) -> Array:
        """Rates of damage at operating points.

        Args:
            torque: input torques [N m], of either sign, (...).
            speed: input speeds [rad/s], of either sign, (...).
            temperature: oil temperatures [K], (...).

        Returns:
            Miner sums over time [1/s], (..., parts); 0 without torque or without rotation.

        Raises:
            ValueError: a point is outside the map, or a value is not finite.
        """
        raise NotImplementedError


def make_damage_map(scene: Scene, covered: MapRange | None = None) -> DamageMap:
    """The map of a scene with its section `durability`.

    Args:
        scene: scene of the gearbox, with one input.
        covered: what it covers; None is 1.6 times the torque of the scene within its limit, 0.03 to
            1.5 times its speed, and 20 K around its oil temperature.

    Returns:
        The map; nothing is computed yet.

    Raises:
        SceneError: the scene has two inputs or no section `durability`.
    """
    raise NotImplementedError
