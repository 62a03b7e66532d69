"""Loss torque of a scene over torque, speed and oil temperature: a table of quasi-static runs."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..scene import Scene
from ..scene.errors import Errors
from ..scene.mesh import Runout
from ..simulation.simulate import simulate
from .train import followed_train

Array = NDArray[np.float64]

TORQUES = 0.02, 0.08, 0.25, 0.5, 1.0, 1.6  # of the torque of the scene
SPEEDS = 0.03, 0.12, 0.35, 0.7, 1.0, 1.5  # of the speed of the scene
HEATING = -20.0, 0.0, 20.0  # [K] from the temperature of the scene
CYCLES = 2  # mesh cycles of a run; all are equal
TOLERANCE = 1e-4
COLDEST, HOTTEST = 233.15, 433.15  # [K] of a scene


class Loss(NamedTuple):
    """Loss torques at the input [N m], against the rotation."""

    teeth: float
    """Loss torque of tooth friction."""
    slope: float
    """Its derivative over the magnitude of the torque [-]."""
    rest: float
    """Loss torque of bearings, drag and churning in the scene."""


class LossMap:
    """Loss torque, interpolated in a table whose points are computed when they are needed.

    Tooth friction over torque is interpolated in the logarithms of torque and speed, the rest in
    torque and speed. Beyond the table, the coefficient of friction is that at its edge.

    Args:
        scene: scene of the gearbox, with one input.

    Raises:
        SceneError: the scene has two inputs.
    """

    def __init__(self, scene: Scene) -> None:
        train = followed_train(scene)
        self._scene, self._cycles = _quasi_static(scene), abs(float(train.cycles))
        torques = np.minimum(train.torque * np.array(TORQUES), scene.drive.torque_limit)
        speeds = np.minimum(train.speed * np.array(SPEEDS), train.speed_limit)
        heat = np.clip(train.oil_temperature + np.array(HEATING), COLDEST, HOTTEST)
        self._torques, self._speeds, self._heat = map(np.unique, (torques, speeds, heat))
        self._tables: dict[tuple[bool, int], tuple[Array, Array]] = {}
        # Plain numbers: a reading needs one point, for which arrays take ten times as long.
        self._lists = [knots.tolist() for knots in self.knots]
        self._logarithms = [np.log(knots).tolist() for knots in (self._torques, self._speeds)]
        self._cells: dict[tuple[bool, int, int, int], list[float]] = {}

    def __call__(self, torque: float, speed: float, temperature: float) -> Loss:
        """Loss torques at an operating point.

        Args:
            torque: input torque [N m].
            speed: input speed [rad/s].
            temperature: oil temperature [K].

        Returns:
            The loss torques.

        Raises:
            RunawayError: a point of the table that is needed has no equilibrium.
        """
        heat_index, heat_fraction = _interval_of(self._lists[2], temperature)
        drives = torque * speed >= 0.0
        cold = self._loss_at(drives, heat_index, torque, speed)
        if heat_fraction == 0.0:
            return cold
        warm = self._loss_at(drives, heat_index + 1, torque, speed)
        return Loss(
            cold.teeth + heat_fraction * (warm.teeth - cold.teeth),
            cold.slope + heat_fraction * (warm.slope - cold.slope),
            cold.rest + heat_fraction * (warm.rest - cold.rest),
        )

    @property
    def knots(self) -> tuple[Array, Array, Array]:
        """Torques [N m], speeds [rad/s] and temperatures [K] of the table, in rising order."""
        return self._torques, self._speeds, self._heat

    def tables(self, drives: bool) -> tuple[Array, Array]:
        """The whole table for one direction of power.

        Args:
            drives: whether the input drives.

        Returns:
            Loss torque of tooth friction over the torque [-], and the other loss torque [N m],
            (temperatures, speeds, torques) each.

        Raises:
            RunawayError: a point has no equilibrium.
        """
        every_knot = slice(None)
        parts = [
            self._table_part(drives, k, every_knot, every_knot) for k in range(len(self._heat))
        ]
        return np.stack([teeth for teeth, _ in parts]), np.stack([rest for _, rest in parts])

    def _loss_at(self, drives: bool, heat_index: int, torque: float, speed: float) -> Loss:
        """Loss at the temperature `heat_index` of the table."""
        torque_size, speed_size = max(abs(torque), 1e-9), max(abs(speed), 1e-9)
        speed_index, speed_fraction = _interval_of(self._logarithms[1], math.log(speed_size))
        torque_index, torque_fraction = _interval_of(self._logarithms[0], math.log(torque_size))
        a, b, c, d, *rest = self._cell(drives, heat_index, speed_index, torque_index)
        low, high = a + speed_fraction * (c - a), b + speed_fraction * (d - b)
        coefficient = low + torque_fraction * (high - low)
        log_slope = (high - low) / (
            self._logarithms[0][torque_index + 1] - self._logarithms[0][torque_index]
        )
        a, b, c, d = rest
        speed_fraction = _fraction(self._lists[1], speed_index, speed_size)
        low, high = a + speed_fraction * (c - a), b + speed_fraction * (d - b)
        other_loss = low + _fraction(self._lists[0], torque_index, torque_size) * (high - low)
        return Loss(
            coefficient * torque_size,
            coefficient + (log_slope if 0.0 < torque_fraction < 1.0 else 0.0),
            other_loss,
        )

    def _cell(
        self, drives: bool, heat_index: int, speed_index: int, torque_index: int
    ) -> list[float]:
        """Corners of a cell, first of tooth friction, then of the rest; torque varies fastest."""
        place = drives, heat_index, speed_index, torque_index
        if place not in self._cells:
            speeds, torques = (
                slice(speed_index, speed_index + 2),
                slice(torque_index, torque_index + 2),
            )
            teeth, rest = self._table_part(drives, heat_index, speeds, torques)
            self._cells[place] = [*teeth.ravel().tolist(), *rest.ravel().tolist()]
        return self._cells[place]

    def _table_part(
        self, drives: bool, heat_index: int, speeds: slice, torques: slice
    ) -> tuple[Array, Array]:
        """Part of the table: loss torque of tooth friction over torque, and of the rest,
        (speeds, torques) each."""
        shape = len(self._speeds), len(self._torques)
        teeth, rest = self._tables.setdefault(
            (drives, heat_index), (np.full(shape, np.nan), np.full(shape, np.nan))
        )
        unknown = np.argwhere(np.isnan(teeth[speeds, torques]))
        for speed_index, torque_index in np.add(unknown, [speeds.start or 0, torques.start or 0]):
            torque = float(self._torques[torque_index])
            point = float(self._speeds[speed_index]), float(self._heat[heat_index])
            losses = self.run(torque if drives else -torque, *point)
            teeth[speed_index, torque_index], rest[speed_index, torque_index] = (
                losses[0] / torque,
                losses[1],
            )
        return teeth[speeds, torques], rest[speeds, torques]

    def run(self, torque: float, speed: float, temperature: float) -> tuple[float, float]:
        """Simulate an operating point.

        Args:
            torque: input torque [N m].
            speed: input speed [rad/s], above 0.
            temperature: oil temperature [K].

        Returns:
            Loss torques of tooth friction and of all other losses [N m].

        Raises:
            RunawayError: there is no equilibrium.
        """
        scene = self._scene.replace(
            input_torque=torque, input_speed=speed, oil_temperature=temperature
        )
        duration = CYCLES * 2.0 * math.pi / (self._cycles * speed)
        run = simulate(scene, duration, 4.0 / duration, tolerance=TOLERANCE)
        angle = run.duration * speed
        energy = run.energy
        return energy.friction / angle, (energy.bearing + energy.churning) / angle


def _interval_of(knots: Sequence[float], value: float) -> tuple[int, float]:
    """Index of the interval of a value, and the fraction of that interval from 0 to 1."""
    n = min(max(bisect_right(knots, value) - 1, 0), len(knots) - 2)
    return n, min(max(_fraction(knots, n, value), 0.0), 1.0)


def _fraction(knots: Sequence[float], n: int, value: float) -> float:
    return (value - knots[n]) / (knots[n + 1] - knots[n])


def loss_map(scene: Scene) -> LossMap:
    """Losses of a scene, without its faults, runout and errors.

    Args:
        scene: scene of the gearbox; its dynamics have no effect.

    Returns:
        The map, shared by all callers with the same scene.

    Raises:
        SceneError: the scene has two inputs.
    """
    return _map_of(scene.model_dump_json())


@lru_cache(maxsize=16)
def _map_of(text: str) -> LossMap:
    return LossMap(Scene.model_validate_json(text))


def _quasi_static(scene: Scene) -> Scene:
    """The scene as a steady quasi-static train whose mesh cycles are all equal."""
    return scene.replace(
        **{
            "dynamics": "quasi_static",
            "faults": (),
            "mesh.runout": Runout().model_dump(),
            "errors": Errors().model_dump(),
            "torque_ripple": 0.0,
            "drive.speed_control.start_speed": None,
        }
    )
