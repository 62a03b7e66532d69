"""Torque transducers at both shafts."""

from __future__ import annotations

from ..train import FollowedTrain
from .sensor import Array, Range, Sensor

HIGHEST = 2.0  # multiple of the limit of the scene that a reading may reach


class Torque(Sensor):
    """A torque transducer."""

    quantity, unit, interface = "torque", "N m", "effort"
    spellings = "N m, N mm, kN m or lbf ft"
    shown = 0.2

    def nominal(self, train: FollowedTrain) -> float:
        """Magnitude at the operating point of the scene [N m]."""
        return train.torque / (1.0 if self.place == "input" else abs(train.ratio))

    def limits(self, train: FollowedTrain) -> Range:
        """Torques that the machines of a scene can have [N m]."""
        highest, limited_by = HIGHEST * train.torque_limit, f"{HIGHEST:g} times drive.torque_limit"
        if self.place == "input":
            return Range(-highest, highest, limited_by)
        highest /= abs(train.ratio)
        return Range(-highest, highest, f"{limited_by} at the output")

    def as_written(self, values: Array) -> list[Array]:
        """Readings in N m, kN m and N mm."""
        return [values * factor for factor in (1.0, 1e-3, 1e3)]
