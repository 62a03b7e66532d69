"""Warns of torques and speeds that are far from those of the scene: their unit may be wrong."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

from ..scene import OperatingPoint

SMALL = 0.005  # share of the torque of the scene; an idle gearbox usually takes more
FAST = 5.0  # multiple of the speed of the scene
TURNING = 0.05  # share of the speed of the scene below which a bin is at standstill
FEWEST = 50  # bins in which the gearbox turns, from which torque and speed are judged


@dataclass
class UnitRemarks:
    """Compares torques and speeds of the input with the scene while the gearbox turns.

    A unit that is wrong in both torques, or in both speeds, leaves their ratio correct.

    Args:
        point: operating point of the scene; a torque or speed of zero is not compared.
    """

    point: OperatingPoint
    _torque: float = field(default=0.0, init=False)  # [N m] largest magnitude
    _speeds: float = field(default=0.0, init=False)  # [rad/s] sum of magnitudes
    _count: int = field(default=0, init=False)

    def add(self, torque: float, speed: float) -> None:
        """Add the means of a bin.

        Args:
            torque: input torque [N m], NaN if it is missing.
            speed: input speed [rad/s], NaN if it is missing.
        """
        if not abs(speed) > TURNING * abs(self.point.input_speed):
            return
        self._count += 1
        self._speeds += abs(speed)
        if not math.isnan(torque):
            self._torque = max(self._torque, abs(torque))

    def remarks(self) -> Iterator[str]:
        """Lines that ask for the unit, if torques or speeds are far from those of the scene."""
        if self._count >= FEWEST:
            yield from unit_remarks(self.point, self._torque, self._speeds / self._count)


def unit_remarks(point: OperatingPoint, torque: float, speed: float) -> Iterator[str]:
    """Lines that ask for the unit, if torques or speeds are far from those of the scene.

    Args:
        point: operating point of the scene; a torque or speed of zero is not compared.
        torque: largest magnitude of the input torque while the gearbox turns [N m].
        speed: mean magnitude of the input speed while it turns [rad/s].
    """
    usual_torque, usual_speed = abs(point.input_torque), abs(point.input_speed)
    if 0.0 < torque < SMALL * usual_torque:
        yield (
            f"input_torque is at most {torque:.3g} N m, and that of the scene is "
            f"{usual_torque:.3g} N m: is the unit of both torques right? The field effort of a "
            "JointState must be in N m; a table in kN m needs the heading input_torque [kN m]"
        )
    if usual_speed > 0.0 and speed > FAST * usual_speed:
        yield (
            f"input_speed is {speed:.4g} rad/s on average, {speed / usual_speed:.3g} times that of "
            "the scene: is the unit of both speeds right? The number in rpm is 9.55 times that in "
            "rad/s. The field velocity of a JointState must be in rad/s; a table in rpm needs the "
            "heading input_speed [rpm]"
        )
