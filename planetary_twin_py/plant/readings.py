"""Readings of torque, speed and oil temperature of a plant."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..following.loss_map import loss_map
from ..following.train import FollowedTrain, followed_train
from ..scene import Scene
from ..sensors.converter import ErrorModel
from ..sensors.torque import torque_errors
from .course import Course, draw_course
from .hidden import Hidden
from .pattern import Stage, error_stages

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Plant:
    """A gearbox that runs a duty and changes during it, unknown to a follower of `scene`.

    Raises `ValueError` if the duration [s] is shorter than a period of the sensors, or if the
    hidden state does not fit the scene.
    """

    scene: Scene
    hidden: Hidden
    duration: float

    def __post_init__(self) -> None:
        period = 1.0 / self.hidden.sensors.rate
        if not self.duration >= period:
            raise ValueError(
                f"duration = {self.duration!r} s: must be at least a period of the sensors, "
                f"{period:g} s"
            )
        self.hidden.check(self.scene)

    @cached_property
    def true_scene(self) -> Scene:
        """The scene with the laws of the plant."""
        return self.scene.replace(**self.hidden.scene)

    @cached_property
    def train(self) -> FollowedTrain:
        """The train with the laws of the plant."""
        return followed_train(self.true_scene)

    @cached_property
    def course(self) -> Course:
        """Torque and speed over time."""
        train = self.train
        chance = np.random.default_rng([self.hidden.seed, 0])
        hidden = self.hidden
        return draw_course(hidden.duty, hidden.changes_in_order, train, self.duration, chance)

    @cached_property
    def error_stages(self) -> tuple[Stage, ...]:
        """Transmission error before and after every change of faults; it takes seconds."""
        return error_stages(self.true_scene, self.hidden.changes_in_order, self.train)

    def at(self, name: str, time: Array, default: float) -> Array:
        """Values at times [s], (n,), of a field of `Change`; `default` before the first change."""
        values = np.full(len(time), default)
        for change in self.hidden.changes_in_order:
            value = getattr(change, name)
            if value is not None:
                values[time >= change.at] = value
        return values


def simulate_readings(plant: Plant) -> tuple[Array, dict[str, Array]]:
    """Simulate stamps [s] and readings in SI by channel, (n,) each, in the order of their arrival.

    The losses are those of the quasi-static train, see `loss_map`. The input torque also
    accelerates the inertia of the whole train. They are NaN where they are lost.
    """
    train, course = plant.train, plant.course
    sensors = plant.hidden.sensors
    time = np.arange(1, int(plant.duration * sensors.rate) + 1) / sensors.rate
    torque, speed = course.torque_at(time), course.speed_at(time)
    driving = torque + train.inertia * course.acceleration_at(time)
    output_time = time + sensors.clock_offset
    driven = (_loss(plant, output_time, course.torque_at(output_time), course.speed_at(output_time))
              - course.torque_at(output_time)) / train.ratio  # fmt: skip
    chance = np.random.default_rng([plant.hidden.seed, 1])
    at_input, at_output = sensors.input_torque, sensors.output_torque
    tachometer = ErrorModel(sensors.speed_noise, 0.0, 0.0)
    zero = plant.at("torque_zero", time, at_input.zero)
    noise = chance.standard_normal((4, len(time)))
    columns = {
        "input_torque": torque_errors(at_input)._replace(zero=0.0).reading(driving, noise[0])
        + zero,
        "output_torque": torque_errors(at_output).reading(driven, noise[1]),
        "input_speed": tachometer.reading(speed, noise[2]),
        "output_speed": tachometer.reading(train.ratio * speed, noise[3]),
    }
    for name, values in columns.items():
        if name.endswith("torque"):
            outlying = chance.random(len(time)) < sensors.outlying
            values[outlying] = train.torque * chance.standard_cauchy(int(outlying.sum()))
        values[chance.random(len(time)) < sensors.lost] = np.nan
    columns["oil_temperature"] = np.full(len(time), train.oil_temperature)
    return time, columns


def _loss(plant: Plant, time: Array, torque: Array, speed: Array) -> Array:
    """Loss torque at the input, with the sign of the speed [N m], (n,)."""
    losses = loss_map(plant.true_scene)
    oil = plant.true_scene.operating_point.oil_temperature
    teeth, rest = losses(torque, speed, oil)
    friction, drag = plant.at("friction", time, 1.0), plant.at("drag", time, 0.0)
    return np.asarray(np.sign(speed) * (friction * teeth + rest + drag))
