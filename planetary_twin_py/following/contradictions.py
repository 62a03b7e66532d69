"""Recognises a wrong unit, a wrong sign or exchanged shafts in some seconds of readings."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import permutations
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..engineering_units import percent
from .named_unit import named_unit
from .sensors import Sensors, torque_gain, torque_zero
from .train import FollowedTrain

Array = NDArray[np.float64]

CHANNELS = "input_speed", "output_speed", "input_torque", "output_torque"
RPM = 30.0 / math.pi
NEAR = 0.02  # relative deviation within which two speed ratios agree
EFFICIENCY = 0.3, 1.15  # plausible range of a torque ratio over that without loss
LOADED = 0.2  # share of the torque of the scene below which torques are not compared
INERTIAL = 0.3  # share of the torque for the acceleration above which torques are not compared
FEWEST = 5  # rows of which torques are compared: fewer do not show what accelerates the train
SEVERAL = 3  # rows that must exceed the speed limit: one may be an error of transmission
EXCESS = 10.0  # multiple of the torque limit that no overload reaches, but a wrong unit does
SMALL = 0.05  # share of the torque of the scene below which a unit may be 1000 times too large
MOVING = 0.05  # share of the speed of the scene below which speeds are not compared
CELSIUS = 200.0  # [K]; below this, a temperature is not in kelvin
GAINED = 4.0  # standard deviations by which a loss may be negative
HOTTEST = 475.0  # [K]; above this, kelvin were given in place of degrees Celsius


class Rows(NamedTuple):
    """Readings in the order of time."""

    time: Array
    """Ends of the rows [s], (n,)."""
    columns: Mapping[str, Array]
    """Readings in SI by channel of `CHANNELS`, (n,) each; NaN where a reading is missing."""


@dataclass(frozen=True)
class Contradictions:
    """Compares readings with the scene.

    Args:
        train: gear train of the scene.
        sensors: accuracy of the torque sensors.
        length: time over which a row is averaged [s].
    """

    train: FollowedTrain
    sensors: Sensors
    length: float

    def shown_by(self, rows: Rows) -> dict[str, str]:
        """Compare some rows.

        Args:
            rows: the readings.

        Returns:
            By name of the comparison, a line with channel, value and correction; empty if the
            readings agree with the scene. Comparisons that the readings do not allow are missing.
        """
        train = self.train
        speed_in, speed_out, input_torque, output_torque = (rows.columns[name] for name in CHANNELS)
        found: dict[str, str] = {}
        speeds = np.sort(np.abs(speed_in[np.isfinite(speed_in)]))
        if len(speeds) >= SEVERAL:
            found["speed limit"] = self._speed_limit(float(speeds[-SEVERAL]))
        moving = (np.abs(speed_in) > MOVING * train.speed) & np.isfinite(speed_out)
        if moving.any():
            found["speeds"] = self._speeds(float(np.median(speed_out[moving] / speed_in[moving])))
        speed = np.where(np.isfinite(speed_in), speed_in, speed_out / train.ratio)
        loaded = self._loaded(rows.time, speed, input_torque, output_torque)
        if loaded.sum() >= FEWEST:
            found["dead torque"] = self._dead(input_torque[loaded], output_torque[loaded])
            if found["dead torque"]:
                return found  # whose other comparisons of torques would mislead
        loaded &= input_torque != 0.0
        if loaded.sum() >= FEWEST:
            ratio = float(np.median(output_torque[loaded] / input_torque[loaded]))
            size = float(np.median(np.abs(input_torque[loaded])))
            found["torques"] = self._torques(ratio, size)
            found["torque limit"] = self._torque_limit(size)
        usable = (np.abs(speed) > MOVING * train.speed) & np.isfinite(input_torque + output_torque)
        if usable.sum() >= FEWEST:
            line = self._loss(speed[usable], input_torque[usable], output_torque[usable])
            if line or loaded.any():  # without load, a loss of nearly zero shows no sign
                found["loss"] = line
        return found

    @property
    def _inertia(self) -> float:
        """Moment of inertia between both torque sensors, referred to the input [kg m^2]."""
        return self.train.inertia if self.sensors.inertia is None else self.sensors.inertia

    def _loaded(
        self, time: Array, speed: Array, input_torque: Array, output_torque: Array
    ) -> NDArray[np.bool_]:
        """Rows whose torques differ by the loss only."""
        size = np.fmax(np.abs(input_torque), np.abs(self.train.ratio * output_torque))
        loaded = size > LOADED * self.train.torque
        loaded &= np.isfinite(input_torque) & np.isfinite(output_torque)
        if len(time) > 1 and np.diff(time).min() > 0.0:
            inertial = np.abs(self._inertia * np.gradient(speed, time))
            loaded &= ~(inertial > INERTIAL * size)  # true without a speed
        return loaded

    def _dead(self, input_torque: Array, output_torque: Array) -> str:
        """Line on a torque that is exactly 0 in all rows in which the other one is not."""
        torques = {"input_torque": input_torque, "output_torque": output_torque}
        for (name, values), (other, load) in permutations(torques.items()):
            if not values.any():
                size = float(np.median(np.abs(load)))
                return (
                    f"{name} is exactly 0 and {other} is {size:.4g} N m: is the sensor of {name} "
                    "connected?"
                )
        return ""

    def _speed_limit(self, peak: float) -> str:
        limit = self.train.speed_limit
        if peak <= 1.2 * limit:
            return ""
        return (
            f"input_speed = {peak:.4g}: exceeds drive.speed_limit = {limit:.4g} rad/s; probably "
            f"rpm: scale input_speed by {1.0 / RPM:.6g}"
        )

    def _torque_limit(self, size: float) -> str:
        limit = self.train.torque_limit
        if size <= EXCESS * limit:
            return ""
        return (
            f"input_torque = {size:.4g} N m: exceeds {EXCESS:g} times drive.torque_limit = "
            f"{limit:.4g} N m; if torques are in N mm, scale input_torque and output_torque by "
            "0.001"
        )

    def _loss(self, speed: Array, input_torque: Array, output_torque: Array) -> str:
        """Line on a loss that is negative beyond the errors of the sensors.

        Two reversed signs leave the ratios correct, so only the loss shows them.
        """
        train, count, sign = self.train, len(speed), np.sign(speed)
        losses = sign * (input_torque + train.ratio * output_torque)
        loss, torque = float(np.mean(losses)), float(np.mean(sign * input_torque))
        stored = self._inertia * float(np.ptp(np.abs(speed))) / (count * self.length)
        sd = math.hypot(
            torque_zero(self.sensors, train),
            torque_gain(self.sensors) * torque,
            stored,
            float(np.std(losses)) / math.sqrt(count),
        )
        if loss >= -GAINED * sd:
            return ""
        line = (
            f"loss torque = {loss:.3g} N m: must be positive: the signs of both torques or of both "
            "speeds are reversed (scale input_torque and output_torque by -1), or a torque sensor "
            "has a wrong zero"
        )
        if abs(loss) < abs(torque):
            line += f" or a gain that is wrong by {percent(abs(loss / torque))} at least"
            if unit := named_unit(1.0 - loss / torque):
                line += f"; {unit}"
        return line

    def _speeds(self, ratio: float) -> str:
        """Line on a measured speed ratio, and its correction."""
        expected = self.train.ratio
        if abs(ratio / expected - 1.0) < NEAR:
            return ""
        statement = f"output_speed/input_speed = {ratio:.4g}: must be {expected:.4g} by the teeth"
        for factor, cause, remedy in (
            (-1.0, "the sign of one speed is reversed", ("output_speed", -1.0)),
            (RPM, "output_speed is probably in rpm", ("output_speed", 1.0 / RPM)),
            (1.0 / RPM, "input_speed is probably in rpm", ("input_speed", 1.0 / RPM)),
            (-RPM, "output_speed is probably in rpm and reversed", ("output_speed", -1.0 / RPM)),
            (
                -1.0 / RPM,
                "input_speed is probably in rpm, and one sign is reversed",
                ("input_speed", -1.0 / RPM),
            ),
            (180.0 / math.pi, "output_speed is probably in deg/s", ("output_speed", math.pi / 180)),
            (math.pi / 180.0, "input_speed is probably in deg/s", ("input_speed", math.pi / 180)),
        ):
            if abs(ratio / (expected * factor) - 1.0) < NEAR:
                return f"{statement}; {cause}: scale {remedy[0]} by {remedy[1]:.6g}"
        if abs(ratio * expected - 1.0) < NEAR:
            return f"{statement}; input and output are exchanged"
        return f"{statement}; no unit explains it: are these the shafts of this scene?"

    def _torques(self, ratio: float, size: float) -> str:
        """Line on a measured torque ratio; `size` is the magnitude of the input torque."""
        expected = -1.0 / self.train.ratio
        share = ratio / expected
        low, high = EFFICIENCY
        if low <= share <= 1.0 / low:
            return ""
        statement = (
            f"output_torque/input_torque = {ratio:.4g}: must be near {expected:.4g} (no loss)"
        )
        if low <= -share <= 1.0 / low:
            return f"{statement}; the sign of one torque is reversed: scale output_torque by -1"
        sign = int(math.copysign(1.0, share))
        for factor, name, unit, scale in (
            (1e3, "output_torque", "N mm", 1e-3)
            if size > SMALL * self.train.torque
            else (1e3, "input_torque", "kN m", 1e3),
            (1e-3, "output_torque", "kN m", 1e3)
            if size < self.train.torque / SMALL
            else (1e-3, "input_torque", "N mm", 1e-3),
        ):
            if low <= abs(share) / factor <= high:
                return (
                    f"{statement}; {name} is probably in {unit}: scale {name} by {sign * scale:g}"
                )
        for close in (0.1, 0.5):  # a unit is named where neither of these is close
            if abs(ratio * expected - 1.0) < close:
                return f"{statement}; input_torque and output_torque seem to be exchanged"
            if abs(abs(ratio) - 1.0) < close:
                return f"{statement}; both torques seem to be referred to the same shaft"
            if unit := named_unit(share):
                return f"{statement}; {unit}"
        return f"{statement}; no unit explains it"


def impossible_temperature(value: float) -> str:
    """Line on an oil temperature in a wrong unit; empty if it is possible.

    Args:
        value: the temperature [K].
    """
    if value < CELSIUS:
        return (
            f"oil_temperature = {value:.4g}: must be in kelvin; this is probably degC: name the "
            "column oil_temperature [degC]"
        )
    if value > HOTTEST:
        return (
            f"oil_temperature = {value:.4g} K: must be at most {HOTTEST:g} K; messages and columns "
            "[degC] are in degrees Celsius, and this sender probably uses kelvin"
        )
    return ""
