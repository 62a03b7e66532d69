"""Recognises a wrong unit, a wrong sign or exchanged shafts in the first seconds of readings."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from .bins import Bin
from .train import FollowedTrain

CHECKED = 5.0  # [s]
RPM = 30.0 / math.pi
NEAR = 0.02  # relative deviation within which two speed ratios agree
EFFICIENCY = 0.3, 1.15  # plausible range of a torque ratio over that without loss
LOADED = 0.2  # share of the torque of the scene below which torques are not compared
EXCESS = 10.0  # multiple of the torque limit that no overload reaches, but a wrong unit does
SMALL = 0.05  # share of the torque of the scene below which a unit may be 1000 times too large
MOVING = 0.05  # share of the speed of the scene below which speeds are not compared
CELSIUS = 200.0  # below this, a temperature is not in kelvin
GAINED = 4.0  # standard deviations by which a loss may be negative
HOTTEST = 475.0  # [K]; above this, the message had kelvin in place of degrees Celsius


class InputError(ValueError):
    """Readings that contradict the scene; the message names channel, value and correction."""


@dataclass
class Checks:
    """Compares the first readings with the scene.

    Args:
        train: gear train of the scene.
        length: length of a bin [s].
        zero: standard deviation of the zeros of both torque sensors, at the input [N m].
        gain: standard deviation of the difference of their gains.
    """

    train: FollowedTrain
    length: float
    zero: float
    gain: float
    _readings: dict[str, list[float]] = field(default_factory=dict)
    _begin: int | None = None
    _done: bool = False

    def add(self, found: Bin) -> None:
        """Add a bin; at the end of the first seconds, check the readings.

        Args:
            found: the bin.

        Raises:
            InputError: a channel has another unit, sign or shaft.
        """
        if self._done:
            return
        if self._begin is None:
            self._begin = found.number
        for name in ("input_speed", "output_speed", "input_torque", "output_torque"):
            mean = found.means.get(name)
            self._readings.setdefault(name, []).append(math.nan if mean is None else mean.value)
        if "oil_temperature" in found.means:
            self._check_temperature(found.means["oil_temperature"].value)
        if (found.number - self._begin + 1) * self.length >= CHECKED:
            self.check()

    def check(self) -> None:
        """Check what has been read so far.

        Raises:
            InputError: see `add`.
        """
        self._done = True
        for line in self._faults():
            raise InputError(line)

    def _check_temperature(self, value: float) -> None:
        if value < CELSIUS:
            raise InputError(
                f"oil_temperature = {value:.4g}: must be in kelvin; this is probably degC: name "
                "the column oil_temperature [degC]"
            )
        if value > HOTTEST:
            raise InputError(
                f"oil_temperature = {value:.4g} K: must be at most {HOTTEST:g} K; messages are in "
                "degrees Celsius by definition, and this sender probably uses kelvin"
            )

    def _faults(self) -> Iterator[str]:
        columns = {name: np.array(values) for name, values in self._readings.items()}
        if not columns:
            return
        train = self.train
        speed_in, speed_out = columns["input_speed"], columns["output_speed"]
        peak_speed = (
            np.nanmax(np.abs(speed_in), initial=0.0) if np.isfinite(speed_in).any() else 0.0
        )
        if peak_speed > 1.2 * train.speed_limit:
            yield (
                f"input_speed = {peak_speed:.4g}: exceeds drive.speed_limit = "
                f"{train.speed_limit:.4g} rad/s; probably rpm: scale input_speed by "
                f"{1.0 / RPM:.6g}"
            )
        moving = (np.abs(speed_in) > MOVING * train.speed) & np.isfinite(speed_out)
        if moving.any():
            ratio = float(np.median(speed_out[moving] / speed_in[moving]))
            yield from self._speed_fault(ratio)
        input_torque, output_torque = columns["input_torque"], columns["output_torque"]
        least_torque = LOADED * train.torque
        loaded = (np.abs(input_torque) > least_torque) | (
            np.abs(train.ratio * output_torque) > least_torque
        )
        loaded &= np.isfinite(input_torque) & np.isfinite(output_torque) & (input_torque != 0.0)
        if loaded.any():
            ratio = float(np.median(output_torque[loaded] / input_torque[loaded]))
            size = float(np.median(np.abs(input_torque[loaded])))
            yield from self._torque_fault(ratio, size)
            if size > EXCESS * train.torque_limit:
                yield (
                    f"input_torque = {size:.4g} N m: exceeds {EXCESS:g} times drive.torque_limit = "
                    f"{train.torque_limit:.4g} N m; if torques are in N mm, scale input_torque "
                    "and output_torque by 0.001"
                )
        yield from self._negative_loss(input_torque, output_torque, speed_in, speed_out)

    def _negative_loss(
        self,
        input_torque: np.ndarray,
        output_torque: np.ndarray,
        speed_in: np.ndarray,
        speed_out: np.ndarray,
    ) -> Iterator[str]:
        """Fault of a loss that is negative beyond the errors of the sensors.

        Two reversed signs leave the ratios correct, so only the loss shows them.
        """
        train = self.train
        speed = np.where(np.isfinite(speed_in), speed_in, speed_out / train.ratio)
        usable = (np.abs(speed) > MOVING * train.speed) & np.isfinite(input_torque + output_torque)
        if not usable.any():
            return
        speed, input_torque, output_torque = (
            speed[usable],
            input_torque[usable],
            output_torque[usable],
        )
        sign = np.sign(speed)
        loss = float(np.mean(sign * (input_torque + train.ratio * output_torque)))
        stored = train.inertia * float(np.ptp(np.abs(speed))) / (len(speed) * self.length)
        sd = math.hypot(self.zero, self.gain * float(np.mean(sign * input_torque)), stored)
        if loss < -GAINED * sd:
            percentage = 100.0 * loss / float(np.mean(sign * input_torque))
            yield (
                f"loss torque = {loss:.3g} N m: must be positive: the signs of both torques or of "
                "both speeds are reversed (scale input_torque and output_torque by -1), or a "
                f"torque sensor has a wrong zero or a gain that is wrong by {abs(percentage):.2g} %"
            )

    def _speed_fault(self, ratio: float) -> Iterator[str]:
        """Fault of a measured speed ratio, and its correction."""
        expected = self.train.ratio
        if abs(ratio / expected - 1.0) < NEAR:
            return
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
                yield f"{statement}; {cause}: scale {remedy[0]} by {remedy[1]:.6g}"
                return
        if abs(ratio * expected - 1.0) < NEAR:
            yield f"{statement}; input and output are exchanged"
            return
        yield f"{statement}; no unit explains it: are these the shafts of this scene?"

    def _torque_fault(self, ratio: float, size: float) -> Iterator[str]:
        """Fault of a measured torque ratio; `size` is the magnitude of the input torque."""
        expected = -1.0 / self.train.ratio
        share = ratio / expected
        low, high = EFFICIENCY
        if low <= share <= 1.0 / low:
            return
        statement = (
            f"output_torque/input_torque = {ratio:.4g}: must be near {expected:.4g} (no loss)"
        )
        if low <= -share <= 1.0 / low:
            yield f"{statement}; the sign of one torque is reversed: scale output_torque by -1"
            return
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
                yield f"{statement}; {name} is probably in {unit}: scale {name} by {sign * scale:g}"
                return
        if abs(share * expected**2 - 1.0) < 0.5:
            yield f"{statement}; both torques seem to be referred to the same shaft"
            return
        yield f"{statement}; no unit explains it"
