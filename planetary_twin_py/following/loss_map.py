"""Loss torque of a scene over torque, speed and oil temperature: a table of quasi-static runs."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..scene import Scene
from ..scene.errors import Errors
from ..scene.mesh import Runout
from ..simulation import simulate
from .train import followed_train

Array = NDArray[np.float64]

TORQUES = 0.02, 0.08, 0.25, 0.5, 1.0, 1.6  # of the torque of the scene
SPEEDS = 0.03, 0.12, 0.35, 0.7, 1.0, 1.5  # of the speed of the scene
HEATING = -20.0, 0.0, 20.0  # [K] from the temperature of the scene
CYCLES = 2  # mesh cycles of a run; all are alike
TOLERANCE = 1e-4
COLDEST, HOTTEST = 233.15, 433.15  # [K] of a scene


class Loss(NamedTuple):
    """Loss torques at the input [N m], against the rotation."""

    teeth: float
    """Of tooth friction."""
    slope: float
    """Its derivative over the magnitude of the torque [-]."""
    rest: float
    """Of bearings, drag and churning as the scene has them."""


class LossMap:
    """Loss torque between the points of a table, linear in the logarithms of torque and speed.

    Tooth friction is tabulated as loss torque over torque, which changes little. Below the smallest
    torque and speed of the table this coefficient is that at its edge.

    Args:
        torques: magnitudes [N m], (n,).
        speeds: magnitudes [rad/s], (m,).
        temperatures: of the oil [K], (k,).
        teeth: loss torque of tooth friction over torque; first where the input drives, then where
            it is driven, (2, k, m, n).
        rest: other loss torque [N m], (2, k, m, n).
    """

    def __init__(
        self, torques: Array, speeds: Array, temperatures: Array, teeth: Array, rest: Array
    ) -> None:
        self._torques, self._speeds = np.log(torques), np.log(speeds)
        self._temperatures = temperatures
        self._tables = np.stack([teeth, rest], axis=-1)

    def __call__(self, torque: float, speed: float, temperature: float) -> Loss:
        """Loss at an operating point.

        Args:
            torque: at the input [N m].
            speed: of the input [rad/s].
            temperature: of the oil [K].

        Returns:
            The loss torques.
        """
        size = max(abs(torque), 1e-9)
        at_torque, u = _place(self._torques, math.log(size))
        at_speed, v = _place(self._speeds, math.log(max(abs(speed), 1e-9)))
        at_heat, h = _place(self._temperatures, temperature)
        table = self._tables[0 if torque * speed >= 0.0 else 1]
        corner = table[at_heat : at_heat + 2, at_speed : at_speed + 2, at_torque : at_torque + 2]
        over_torque = np.array([1.0 - v, v]) @ (np.array([1.0 - h, h]) @ corner.reshape(2, -1)).reshape(
            2, -1
        )
        low, low_rest, high, high_rest = over_torque.tolist()
        part = low + u * (high - low)
        step = float(self._torques[at_torque + 1] - self._torques[at_torque])
        inside = 0.0 < u < 1.0
        return Loss(
            teeth=part * size,
            slope=part + ((high - low) / step if inside else 0.0),
            rest=low_rest + u * (high_rest - low_rest),
        )


def _place(knots: Array, value: float) -> tuple[int, float]:
    """Index of the interval of a value, and its place within it from 0 to 1."""
    n = min(max(int(np.searchsorted(knots, value)) - 1, 0), len(knots) - 2)
    return n, min(max((value - float(knots[n])) / float(knots[n + 1] - knots[n]), 0.0), 1.0)


def loss_map(scene: Scene) -> LossMap:
    """Tabulate the losses of a scene, without its faults, runouts and errors.

    Args:
        scene: of the gearbox; dynamics play no role.

    Returns:
        The map.

    Raises:
        SceneError: the scene has two inputs.
        RunawayError: a point of the table has no equilibrium.
    """
    return _tabulated(scene.model_dump_json())


@lru_cache(maxsize=8)
def _tabulated(text: str) -> LossMap:
    scene = Scene.model_validate_json(text)
    train = followed_train(scene)
    torques = np.minimum(train.torque * np.array(TORQUES), scene.drive.torque_limit)
    speeds = np.minimum(train.speed * np.array(SPEEDS), train.speed_limit)
    heat = np.clip(train.oil_temperature + np.array(HEATING), COLDEST, HOTTEST)
    torques, speeds, heat = (np.unique(values) for values in (torques, speeds, heat))
    teeth, rest = np.empty((2, 2, len(heat), len(speeds), len(torques)))
    for place in np.ndindex(teeth.shape):
        drives, k, m, n = place
        torque, speed = float(torques[n]), float(speeds[m])
        there = _plain(scene).replace(
            input_torque=torque if drives == 0 else -torque,
            input_speed=speed,
            oil_temperature=float(heat[k]),
        )
        duration = CYCLES * 2.0 * math.pi / (abs(float(train.cycles)) * speed)
        run = simulate(there, duration, 4.0 / duration, tolerance=TOLERANCE)
        turned = run.duration * speed
        teeth[place] = run.energy.friction / turned / torque
        rest[place] = (run.energy.bearing + run.energy.churning) / turned
    return LossMap(torques, speeds, heat, teeth, rest)


def _plain(scene: Scene) -> Scene:
    """The scene as a steady quasi-static train whose mesh cycles are all alike."""
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
