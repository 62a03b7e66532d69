"""Compares some seconds of readings with the teeth, the losses and the limits of the scene.

A line states what was measured and what the scene allows. It does not guess the cause.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import permutations
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..channels.all import LOADED, MOVING
from ..estimate import CONFIDENT
from ..loss_map import LossMap
from ..sensors import Sensors, balance_errors, inertia_between
from ..train import FollowedTrain

Array = NDArray[np.float64]

CHANNELS = "input_speed", "output_speed", "input_torque", "output_torque"
NEAR = 0.02  # relative deviation within which two speed ratios agree
MOST = 0.7  # share of the torque that a gearbox loses at most beside the loss of its scene
INERTIAL = 0.3  # share of the torque for the acceleration above which torques are not compared
FEWEST = 5  # rows of which torques are compared: fewer do not show what accelerates the train
GAINED = 4.0  # standard deviations by which a loss may be negative
ASK = (
    "state units in the headings, such as input_speed [rpm] or output_torque [lbf ft], and a "
    "reversed sign with --scale NAME=-1"
)


class Rows(NamedTuple):
    """Readings in the order of time."""

    time: Array
    """Ends of the rows [s], (n,)."""
    columns: Mapping[str, Array]
    """Readings in SI by channel of `CHANNELS`, (n,) each; NaN where a reading is missing."""


@dataclass(frozen=True)
class Contradictions:
    """Compares readings, whose rows are averaged over `length` [s], with the scene."""

    train: FollowedTrain
    losses: LossMap
    sensors: Sensors
    length: float

    def shown_by(self, rows: Rows) -> dict[str, str]:
        """A line with channel, value and correction for each comparison; empty if in order.

        Comparisons that the readings do not allow are missing.
        """
        train = self.train
        speed_in, speed_out, input_torque, output_torque = (rows.columns[name] for name in CHANNELS)
        found: dict[str, str] = {}
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
            found["torques"] = self._torques(
                speed[loaded], input_torque[loaded], output_torque[loaded]
            )
        usable = (np.abs(speed) > MOVING * train.speed) & np.isfinite(input_torque + output_torque)
        if usable.sum() >= FEWEST:
            line = self._loss(speed[usable], input_torque[usable], output_torque[usable])
            if line or loaded.any():  # without load, a loss of nearly zero shows no sign
                found["loss"] = line
        return found

    def _loaded(
        self, time: Array, speed: Array, input_torque: Array, output_torque: Array
    ) -> NDArray[np.bool_]:
        """Rows whose torques differ by the loss only."""
        size = np.fmax(np.abs(input_torque), np.abs(self.train.ratio * output_torque))
        loaded = size > LOADED * self.train.torque
        loaded &= np.isfinite(input_torque) & np.isfinite(output_torque)
        if len(time) > 1 and np.diff(time).min() > 0.0:
            inertial = np.abs(inertia_between(self.sensors, self.train) * np.gradient(speed, time))
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

    def _loss(self, speed: Array, input_torque: Array, output_torque: Array) -> str:
        """Line on a loss that is negative beyond the errors of the sensors.

        Two reversed signs leave the ratios correct, so only the loss shows them.
        """
        train, count, sign = self.train, len(speed), np.sign(speed)
        losses = sign * (input_torque + train.ratio * output_torque)
        loss, torque = float(np.mean(losses)), float(np.mean(sign * input_torque))
        stored = (
            inertia_between(self.sensors, self.train)
            * float(np.ptp(np.abs(speed)))
            / (count * self.length)
        )
        errors, scatter = balance_errors(self.sensors, train), float(np.std(losses))
        sd = math.hypot(errors.zero, errors.gain * torque, stored, scatter / math.sqrt(count))
        if loss >= -GAINED * sd:
            return ""
        return (
            f"loss torque = {loss:.3g} +- {CONFIDENT * sd:.2g} N m at input_torque = "
            f"{float(np.mean(input_torque)):.4g} N m: must be positive; are signs, units, zeros "
            f"and gains of both torques right? {ASK}"
        )

    def _speeds(self, ratio: float) -> str:
        """Line on a measured speed ratio."""
        expected = self.train.ratio
        if abs(ratio / expected - 1.0) < NEAR:
            return ""
        return (
            f"output_speed/input_speed = {ratio:.4g}: must be {expected:.4g} by the teeth; which "
            f"shafts, and which units? {ASK}"
        )

    def _torques(self, speed: Array, input_torque: Array, output_torque: Array) -> str:
        """Line on the median of the measured torque ratios."""
        ratios, expected = output_torque / input_torque, -1.0 / self.train.ratio
        ratio = float(np.median(ratios))
        efficiency = ratio / expected
        kept = 1.0 / efficiency if efficiency > 1.0 else efficiency  # of the larger torque
        if kept >= 1.0 - MOST:
            return ""
        n = int(np.argmin(np.abs(ratios - ratio)))
        loss = self.losses(float(input_torque[n]), float(speed[n]), self.train.oil_temperature)
        larger = max(abs(input_torque[n]), abs(output_torque[n] / expected))
        if kept >= max(1.0 - MOST - (loss.teeth + loss.rest) / larger, 0.0):
            return ""
        return (
            f"output_torque/input_torque = {ratio:.4g}: must be near {expected:.4g} (no loss); "
            f"which shafts, and which units? {ASK}"
        )
