"""Course of torque and speed of a plant: straight lines between knots."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..following.train import FollowedTrain
from .hidden import Change, Duty

Array = NDArray[np.float64]

EVERY = 5.0  # [s] from one target of a duty to the next
RAMP = 0.6  # [s] from one to the next
LOAD = 0.27, 1.0  # range of the torques of a varied duty, over that of the scene
SPEED = 0.7, 1.3  # likewise of its speeds
REVERSED = -0.48, 0.95  # torques of a reversing duty
WANDERING = 10.0  # [s] correlation time of what wanders


class Course(NamedTuple):
    """Torque and speed at the input over time; the acceleration is constant between knots."""

    knots: Array
    """[s], (n,)."""
    torque: Array
    """[N m], (n,)."""
    speed: Array
    """[rad/s], (n,)."""
    angle: Array
    """Turned since time zero [rad], (n,)."""

    def torque_at(self, time: Array) -> Array:
        """Torque [N m], without that of the inertia.

        Args:
            time: [s], (m,).

        Returns:
            (m,).
        """
        return np.interp(time, self.knots, self.torque)

    def speed_at(self, time: Array) -> Array:
        """Speed [rad/s].

        Args:
            time: [s], (m,).

        Returns:
            (m,).
        """
        return np.interp(time, self.knots, self.speed)

    def acceleration_at(self, time: Array) -> Array:
        """Acceleration [rad/s^2].

        Args:
            time: [s], (m,).

        Returns:
            (m,).
        """
        n = np.clip(np.searchsorted(self.knots, time, "right") - 1, 0, len(self.knots) - 2)
        return np.asarray((np.diff(self.speed) / np.diff(self.knots))[n])

    def angle_at(self, time: Array) -> Array:
        """Angle of the input [rad].

        Args:
            time: [s], (m,).

        Returns:
            (m,).
        """
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
    """Draw the course of a duty.

    Args:
        duty: its kind, and how much it wanders.
        changes: of them those of the load are used.
        train: whose torque and speed are the mean ones.
        duration: of the course [s].
        chance: source of random numbers.

    Returns:
        The course.
    """
    knots = np.arange(0.0, duration + 0.2, 0.1)
    torque, speed = np.ones_like(knots), np.ones_like(knots)
    targets = int(duration / EVERY) + 2
    if duty.kind == "varied":
        torque = _between(knots, chance.uniform(*LOAD, targets))
        speed = _between(knots, chance.uniform(*SPEED, targets))
    elif duty.kind == "reversing":
        torque = _between(knots, np.resize(REVERSED[::-1], targets))
    torque = torque * (1.0 + duty.torque_wander * _wander(len(knots), 0.1, chance))
    speed = speed * (1.0 + duty.speed_wander * _wander(len(knots), 0.1, chance))
    for change in changes:
        if change.load is not None:
            torque[knots >= change.at] = torque[knots >= change.at] * change.load
    speed = speed * train.speed
    steps = 0.5 * (speed[1:] + speed[:-1]) * np.diff(knots)
    return Course(knots, torque * train.torque, speed, np.concatenate([[0.0], np.cumsum(steps)]))


def _between(knots: Array, targets: Array) -> Array:
    """Targets held for `EVERY` seconds, with ramps between them."""
    begins = EVERY * np.arange(len(targets))
    corners = np.sort(np.concatenate([begins, begins[1:] - RAMP]))
    return np.interp(knots, corners, np.repeat(targets, 2)[: len(corners)])


def _wander(count: int, step: float, chance: np.random.Generator) -> Array:
    """Gauss-Markov process with unit standard deviation, smooth over a second."""
    every = round(1.0 / step)
    keep = np.exp(-1.0 / WANDERING)
    coarse = np.empty(count // every + 2)
    coarse[0] = chance.standard_normal()
    for n, fresh in enumerate(chance.standard_normal(len(coarse) - 1)):
        coarse[n + 1] = keep * coarse[n] + np.sqrt(1.0 - keep**2) * fresh
    return np.interp(np.arange(count) / every, np.arange(len(coarse)), coarse)
