"""Remarks on torques and speeds of another size than those of the scene, as a wrong unit has."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from .train import FollowedTrain

LITTLE = 0.005  # share of the torque of the scene; an idle gearbox takes more
FAST = 5.0  # multiple of the speed of the scene
LEAST = 50  # readings from which the sizes are judged


@dataclass
class Sizes:
    """Largest magnitudes of torque and speed at the input.

    Ratios of two readings do not show a unit that is wrong in both.

    Args:
        train: gear train of the scene.
    """

    train: FollowedTrain
    torque: float = 0.0
    """Largest magnitude of the input torque [N m]."""
    speed: float = 0.0
    """Largest magnitude of the input speed [rad/s]."""
    count: int = 0
    """Number of torques."""

    def add(self, torque: float, speed: float) -> None:
        """Add the means of a bin.

        Args:
            torque: input torque [N m], NaN if it is missing.
            speed: input speed [rad/s], NaN if it is missing.
        """
        if math.isfinite(torque):
            self.torque, self.count = max(self.torque, abs(torque)), self.count + 1
        if math.isfinite(speed):
            self.speed = max(self.speed, abs(speed))

    def remarks(self) -> Iterator[str]:
        """Lines that ask for the unit, if the sizes are not those of the scene."""
        train = self.train
        if self.count >= LEAST and self.torque < LITTLE * train.torque:
            yield (
                f"input_torque is at most {self.torque:.3g} N m, and that of the scene is "
                f"{train.torque:.3g} N m: is the unit of both torques right? A heading of a "
                "table in kilonewton metres must be input_torque [kN m]"
            )
        if self.speed > FAST * train.speed:
            yield (
                f"input_speed is up to {self.speed:.4g} rad/s, {self.speed / train.speed:.3g} "
                "times that of the scene: is its unit right? A reading in rpm is 9.55 times that "
                "in rad/s; its heading must be input_speed [rpm]"
            )
