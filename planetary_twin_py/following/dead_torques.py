"""Notices torques that are exactly 0 while the train turns: a sensor that measures is noisy."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from .checks import CHECKED
from .contradictions import MOVING
from .train import FollowedTrain

TORQUES = "input_torque", "output_torque"


@dataclass
class DeadTorques:
    """Follows how long each torque has been exactly 0.

    Args:
        train: gear train of the scene.
        period: length of a bin [s].
    """

    train: FollowedTrain
    period: float
    _zeros: dict[str, tuple[float, int]] = field(default_factory=dict, init=False)
    """By channel that is 0: since when [s], and in how many bins in which the train turns."""

    def add(self, begin: float, values: Mapping[str, float], speed: float) -> None:
        """Add the means of a bin.

        Args:
            begin: start of the bin [s].
            values: means in SI by channel; a channel without readings is missing.
            speed: input speed [rad/s], NaN if it is missing.
        """
        turns = abs(speed) > MOVING * self.train.speed
        for name in TORQUES:
            if values.get(name, 0.0) != 0.0:
                self._zeros.pop(name, None)
            elif name in values and turns:
                since, count = self._zeros.get(name, (begin, 0))
                self._zeros[name] = since, count + 1

    def remarks(self) -> Iterator[str]:
        """A line for each torque that has become 0 and has stayed 0 while the train turned."""
        for name, (since, count) in self._zeros.items():
            if count * self.period >= CHECKED:
                yield (
                    f"{name} is exactly 0 since {since:.1f} s although the train turns: is its "
                    "sensor connected?"
                )
