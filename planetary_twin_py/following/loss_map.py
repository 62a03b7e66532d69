"""Loss torque of a scene over torque, speed and oil temperature: a table of quasi-static runs."""

from __future__ import annotations

import math
from functools import cached_property, lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..scene import Scene
from ..scene.errors import Errors
from ..scene.mesh import Runout
from ..scene.other_dynamics import under
from ..simulation.simulate import simulate
from .train import followed_train

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

TORQUES = 0.02, 0.08, 0.25, 0.5, 1.0, 1.6  # of the torque of the scene
SPEEDS = 0.03, 0.12, 0.35, 0.7, 1.0, 1.5  # of the speed of the scene
HEATING = -20.0, 0.0, 20.0  # [K] from the temperature of the scene
CYCLES = 2  # mesh cycles of a run; all are equal
TOLERANCE = 1e-4
COLDEST, HOTTEST = 233.15, 433.15  # [K] of a scene
LEAST = 1e-9  # [N m], [rad/s] below which a logarithm is that of this value
CHECKED = 12  # points between those of the table at which its error is measured
SAFETY = 1.5  # ratio of the bound to the largest error at these points


class Loss(NamedTuple):
    """Loss torques at the input [N m], against the rotation, (n,) each."""

    teeth: Array
    """Loss torque of tooth friction."""
    rest: Array
    """Loss torque of bearings, drag and churning in the scene."""

    @property
    def total(self) -> Array:
        """Sum of both [N m], (n,)."""
        return self.teeth + self.rest


class LossMap:
    """Loss torque, interpolated in a table whose points are computed when they are needed.

    A reading of one gearbox needs a few points, which take milliseconds, where the whole table
    takes seconds. Tooth friction over torque is interpolated in the logarithms of torque and speed,
    the rest in torque and speed. Beyond the table, the coefficient of friction is that at its edge.
    Raises `SceneError` for a scene with two inputs.
    """

    def __init__(self, scene: Scene) -> None:
        train = followed_train(scene)
        self._scene, self._cycles = _quasi_static(scene), abs(float(train.cycles))
        torques = np.minimum(train.torque * np.array(TORQUES), scene.drive.torque_limit)
        speeds = np.minimum(train.speed * np.array(SPEEDS), train.speed_limit)
        heat = np.clip(train.oil_temperature + np.array(HEATING), COLDEST, HOTTEST)
        self._heat, self._speeds, self._torques = map(np.unique, (heat, speeds, torques))
        self._logarithms = np.log(self._speeds), np.log(self._torques)
        shape = 2, 2, len(self._heat), len(self._speeds), len(self._torques)
        self._table = np.full(shape, math.nan)
        """Loss torque of the teeth over the torque [-], and of the rest [N m], each for a driven
        and a driving input, by temperature, speed and torque; NaN where it is not computed yet."""

    def __call__(self, torque: ArrayLike, speed: ArrayLike, temperature: ArrayLike) -> Loss:
        """Losses at input torques [N m], speeds [rad/s] and oil temperatures [K], (n,).

        Raises `RunawayError` if a point of the table that is needed has no equilibrium.
        """
        torque, speed, temperature = np.broadcast_arrays(torque, speed, temperature)
        torque_size, speed_size = (
            np.maximum(np.abs(torque), LEAST),
            np.maximum(np.abs(speed), LEAST),
        )
        drives = (torque * speed >= 0.0).astype(np.int64)
        k, heated = _interval_of(self._heat, temperature)
        m, log_speed = _interval_of(self._logarithms[0], np.log(speed_size))
        n, log_torque = _interval_of(self._logarithms[1], np.log(torque_size))
        first = np.ravel_multi_index((drives, k, m, n), self._table.shape[1:])
        corners = self._corners(first, heated > 0.0)
        speeds = np.array([log_speed, _fraction(self._speeds, m, speed_size)])
        torques = np.array([log_torque, _fraction(self._torques, n, torque_size)])
        heat = _between(corners[:, :, :, 0], corners[:, :, :, 1], heated)
        at_speed = _between(heat[:, 0], heat[:, 1], speeds[:, np.newaxis])
        teeth, rest = _between(at_speed[:, 0], at_speed[:, 1], torques)
        return Loss(teeth * torque_size, rest)

    @cached_property
    def error(self) -> float:
        """Bound of the relative error of the loss torque within the table, which it completes."""
        self._compute(np.arange(self._table[0].size))
        fractions = np.random.default_rng(0).random((3, CHECKED))
        knots = self._logarithms[1], self._logarithms[0], self._heat
        log_torque, log_speed, temperature = (
            ends[0] + share * (ends[-1] - ends[0])
            for ends, share in zip(knots, fractions, strict=True)
        )
        points = np.exp(log_torque), np.exp(log_speed), temperature
        exact = np.array([sum(self.run(*map(float, point))) for point in zip(*points, strict=True)])
        return SAFETY * float(np.max(np.abs(self(*points).total / exact - 1.0)))

    def _corners(self, first: Indices, warmer: NDArray[np.bool_]) -> Array:
        """Corners of cells by the places of their first ones, (2, 2, 2, 2, n): of teeth and rest,
        by speed, torque and heat; the table at a higher temperature only where it is needed."""
        speeds, torques = self._table.shape[-2:]
        in_heat = first + np.multiply.outer([0, speeds * torques], warmer)
        cell = np.array([[0, 1], [torques, torques + 1]])
        places = np.add.outer(cell, in_heat)
        corners = self._table.reshape(2, -1)[:, places]
        if np.isnan(corners).any():
            self._compute(places)
            corners = self._table.reshape(2, -1)[:, places]
        return corners

    def _compute(self, places: Indices) -> None:
        """Compute the points of the table that are unknown among some, by their places in it."""
        table = self._table.reshape(2, -1)
        for place in np.unique(places[np.isnan(table[0, places])]):
            drives, k, m, n = np.unravel_index(place, self._table.shape[1:])
            torque = float(self._torques[n])
            teeth, rest = self.run(
                torque if drives else -torque, float(self._speeds[m]), float(self._heat[k])
            )
            table[:, place] = teeth / torque, rest

    def run(self, torque: float, speed: float, temperature: float) -> tuple[float, float]:
        """Simulate an operating point with a speed above 0: loss torques of teeth and rest [N m].

        Raises `RunawayError` if there is no equilibrium.
        """
        scene = self._scene.replace(
            input_torque=torque, input_speed=speed, oil_temperature=temperature
        )
        duration = CYCLES * 2.0 * math.pi / (self._cycles * speed)
        run = simulate(scene, duration, 4.0 / duration, tolerance=TOLERANCE)
        angle = run.duration * speed
        energy = run.energy
        return energy.friction / angle, (energy.bearing + energy.churning) / angle


def _interval_of(knots: Array, value: Array) -> tuple[Indices, Array]:
    """Index of the interval of each value, and its position within it from 0 to 1."""
    n = np.minimum(np.maximum(np.searchsorted(knots, value, "right") - 1, 0), len(knots) - 2)
    return n, np.minimum(np.maximum(_fraction(knots, n, value), 0.0), 1.0)


def _fraction(knots: Array, n: Indices, value: Array) -> Array:
    return np.asarray((value - knots[n]) / (knots[n + 1] - knots[n]))


def _between(low: Array, high: Array, fraction: Array) -> Array:
    return np.asarray(low + fraction * (high - low))


def loss_map(scene: Scene) -> LossMap:
    """Losses of a scene with one input, without faults, runout and errors, shared by callers."""
    return _map_of(scene.model_dump_json())


@lru_cache(maxsize=16)
def _map_of(text: str) -> LossMap:
    return LossMap(Scene.model_validate_json(text))


def _quasi_static(scene: Scene) -> Scene:
    """The scene as a steady quasi-static train whose mesh cycles are all equal."""
    return scene.replace(
        **{
            **under(scene, "quasi_static"),
            "faults": (),
            "mesh.runout": Runout().model_dump(),
            "errors": Errors().model_dump(),
            "torque_ripple": 0.0,
            "drive.speed_control.start_speed": None,
        }
    )
