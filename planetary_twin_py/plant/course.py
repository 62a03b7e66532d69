"""Torque and speed of a plant over time, linear between knots."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..following.train import FollowedTrain
from .changes import Change, Duty

Array = NDArray[np.float64]

EVERY = 5.0  # [s] between two targets of a duty
RAMP = 0.6  # [s] duration of the ramp from one target to the next
LOAD = 0.27, 1.0  # range of the torques of a varied duty, over that of the scene
SPEED = 0.7, 1.3  # range of the speeds of a varied duty, over that of the scene
REVERSED = -0.48, 0.95  # torques of a reversing duty, over that of the scene
TURNED = 1.0, 1.0, -1.0, -1.0  # speeds of a four-quadrant duty, over that of the scene
WANDERING = 10.0  # [s] correlation time of random changes of torque and speed


class Course(NamedTuple):
    """Torque and speed at the input over time; the acceleration is constant between knots."""

    knots: Array
    """Time of the knots [s], (n,)."""
    torque: Array
    """Input torque at the knots [N m], (n,)."""
    speed: Array
    """Input speed at the knots [rad/s], (n,)."""
    angle: Array
    """Angle of the input since time 0 [rad], (n,)."""

    def torque_at(self, time: Array) -> Array:
        """Input torque without the inertia torque [N m] at times [s], (m,)."""
        return np.interp(time, self.knots, self.torque)

    def speed_at(self, time: Array) -> Array:
        """Input speed [rad/s] at times [s], (m,)."""
        return np.interp(time, self.knots, self.speed)

    def acceleration_at(self, time: Array) -> Array:
        """Input acceleration [rad/s^2] at times [s], (m,)."""
        n = np.clip(np.searchsorted(self.knots, time, "right") - 1, 0, len(self.knots) - 2)
        return np.asarray((np.diff(self.speed) / np.diff(self.knots))[n])

    def angle_at(self, time: Array) -> Array:
        """Input angle [rad] at times [s], (m,)."""
        n = np.clip(np.searchsorted(self.knots, time, "right") - 1, 0, len(self.knots) - 2)
        since = time - self.knots[n]
        bend = 0.5 * (np.diff(self.speed) / np.diff(self.knots))[n]
        return np.asarray(self.angle[n] + since * (self.speed[n] + bend * since))


def draw_course(
    duty: Duty,
    changes: tuple[Change, ...],
    train: FollowedTrain,
    duration: float,
    chance: np.random.Generator,
) -> Course:
    """Draw a random course of torque and speed over a duration [s]."""
    knots = np.arange(0.0, duration + 0.2, 0.1)
    torque, speed = np.ones_like(knots), np.ones_like(knots)
    targets = int(duration / EVERY) + 2
    if duty.kind == "varied":
        torque = _between(knots, chance.uniform(*LOAD, targets))
        speed = _between(knots, chance.uniform(*SPEED, targets))
    elif duty.kind != "steady":
        torque = _between(knots, np.resize(REVERSED[::-1], targets))
    if duty.kind == "four_quadrant":
        speed = _between(knots, np.resize(TURNED, targets))
    torque = torque * (1.0 + duty.torque_wander * _gauss_markov(len(knots), 0.1, chance))
    speed = speed * (1.0 + duty.speed_wander * _gauss_markov(len(knots), 0.1, chance))
    load = np.ones_like(knots)
    for change in changes:
        if change.load is not None:
            load[knots >= change.at] = change.load
    torque = torque * load
    speed = speed * train.speed
    steps = 0.5 * (speed[1:] + speed[:-1]) * np.diff(knots)
    return Course(knots, torque * train.torque, speed, np.concatenate([[0.0], np.cumsum(steps)]))


def _between(knots: Array, targets: Array) -> Array:
    """Targets held for `EVERY` seconds, with ramps between them."""
    begins = EVERY * np.arange(len(targets))
    corners = np.sort(np.concatenate([begins, begins[1:] - RAMP]))
    return np.interp(knots, corners, np.repeat(targets, 2)[: len(corners)])


def _gauss_markov(count: int, step: float, chance: np.random.Generator) -> Array:
    """Gauss-Markov process with unit standard deviation, smooth over a second."""
    steps = round(1.0 / step)
    decay = np.exp(-1.0 / WANDERING)
    coarse = np.empty(count // steps + 2)
    coarse[0] = chance.standard_normal()
    for n, noise in enumerate(chance.standard_normal(len(coarse) - 1)):
        coarse[n + 1] = decay * coarse[n] + np.sqrt(1.0 - decay**2) * noise
    return np.interp(np.arange(count) / steps, np.arange(len(coarse)), coarse)
