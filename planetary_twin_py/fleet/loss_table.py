"""Loss torque of a type of gearbox over torque, speed and oil temperature, for arrays of points."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..following.loss_map import LossMap, loss_map
from ..scene import Scene

Array = NDArray[np.float64]

CHECKED = 12  # points between those of the table at which its error is measured
SAFETY = 1.5  # ratio of the bound to the largest error at these points


class Losses(NamedTuple):
    """Loss torques at the input [N m], against the rotation, (n,) each."""

    teeth: Array
    """Loss torque of tooth friction."""
    rest: Array
    """Loss torque of bearings, drag and churning in the scene."""


class LossTable:
    """The complete table of `LossMap`, with a measured error.

    Args:
        losses: losses of the scene.
    """

    def __init__(self, losses: LossMap) -> None:
        self._torques, self._speeds, self._heat = losses.knots
        tables = [losses.tables(drives) for drives in (False, True)]
        self._teeth = np.stack([teeth for teeth, _ in tables])
        self._rest = np.stack([rest for _, rest in tables])
        self.error = self._measured_error(losses)
        """Bound of the relative error of the loss torque within the table."""

    def __call__(self, torque: Array, speed: Array, temperature: Array) -> Losses:
        """Losses at operating points; interpolated as in `LossMap`.

        Args:
            torque: input torques [N m], (n,).
            speed: input speeds [rad/s], (n,).
            temperature: oil temperatures [K], (n,).

        Returns:
            The loss torques.
        """
        torque_size, speed_size = np.maximum(np.abs(torque), 1e-9), np.maximum(np.abs(speed), 1e-9)
        drives = (torque * speed >= 0.0).astype(np.int64)
        heat_index, heat_fraction = _interval_of(self._heat, temperature)
        speed_index, speed_fraction = _interval_of(np.log(self._speeds), np.log(speed_size))
        torque_index, torque_fraction = _interval_of(np.log(self._torques), np.log(torque_size))
        cell = heat_index, speed_index, torque_index
        fractions = heat_fraction, speed_fraction, torque_fraction
        teeth = _interpolate(self._teeth, drives, cell, fractions) * torque_size
        speed_fraction = _fraction(self._speeds, speed_index, speed_size)
        torque_fraction = _fraction(self._torques, torque_index, torque_size)
        fractions = heat_fraction, speed_fraction, torque_fraction
        return Losses(teeth, _interpolate(self._rest, drives, cell, fractions))

    def _measured_error(self, losses: LossMap) -> float:
        """Largest relative error at random points within the table, times a safety factor."""
        chance = np.random.default_rng(0)
        fractions = chance.random((3, CHECKED))
        ends = [np.log(knots[[0, -1]]) for knots in (self._torques, self._speeds)]
        torque, speed = (
            np.exp(low + share * (high - low))
            for share, (low, high) in zip(fractions, ends, strict=False)
        )
        low, high = self._heat[[0, -1]]
        temperature = low + fractions[2] * (high - low)
        interpolated = self(torque, speed, temperature)
        worst = 0.0
        for k in range(CHECKED):
            point = float(torque[k]), float(speed[k]), float(temperature[k])
            exact = sum(losses.run(*point))
            worst = max(
                worst, abs(float(interpolated.teeth[k] + interpolated.rest[k]) / exact - 1.0)
            )
        return SAFETY * worst


def _interval_of(knots: Array, value: Array) -> tuple[NDArray[np.int64], Array]:
    """Index of the interval of each value, and its position within it from 0 to 1."""
    n = np.clip(np.searchsorted(knots, value, "right") - 1, 0, len(knots) - 2)
    return n, np.clip(_fraction(knots, n, value), 0.0, 1.0)


def _fraction(knots: Array, n: NDArray[np.int64], value: Array) -> Array:
    return np.asarray((value - knots[n]) / (knots[n + 1] - knots[n]))


def _interpolate(
    table: Array,
    drives: NDArray[np.int64],
    place: tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]],
    share: tuple[Array, Array, Array],
) -> Array:
    """Interpolate linearly in a cell; the table is (2, temperatures, speeds, torques)."""
    (k, m, n), (h, v, u) = place, share
    _, temperatures, speeds, torques = table.shape
    first = ((drives * temperatures + k) * speeds + m) * torques + n
    steps = np.add.outer([0, speeds * torques], [[0, 1], [torques, torques + 1]])
    corners = table.ravel()[first + steps[..., np.newaxis]]  # (2, 2, 2, n)
    at_speeds = corners[0] + h * (corners[1] - corners[0])
    at_torques = at_speeds[0] + v * (at_speeds[1] - at_speeds[0])
    return np.asarray(at_torques[0] + u * (at_torques[1] - at_torques[0]))


def loss_table(scene: Scene) -> LossTable:
    """Compute the table of a type of gearbox, once in a process.

    Args:
        scene: scene of the type, with one input.

    Returns:
        The table.

    Raises:
        SceneError: the scene has two inputs.
        RunawayError: a point of the table has no equilibrium.
    """
    return _table_of(scene.model_dump_json())


@lru_cache(maxsize=16)
def _table_of(text: str) -> LossTable:
    return LossTable(loss_map(Scene.model_validate_json(text)))
