"""Kalman filters of the torque balances of many gearboxes, in arrays over the gearboxes.

For each gearbox, with torques at both ends and the speed ratio i:

    T_in + i T_out - J a = s (phi L(T, w, oil) + R(w, oil) + d) + b + g T + n
    phi = f + f_T ln(|T|/T0) + f_w ln(|w|/w0),   s = sign(w)

with the parameters, priors and memories of `following.balance_filter`. At these rates, successive
torques T are independent. T is the mean of both ends, weighted by the inverse variances of their
readings. Its error then does not correlate with the noise n of the balance; a correlation would
bias the parameters (errors in variables, Fuller 1987, Measurement Error Models).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import reduce
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..following.balance_filter import (
    DRAG,
    GATE,
    INERTIA,
    LAW,
    LEAST,
    NOISE_MEMORY,
    STANDSTILL,
    Memory,
)
from ..following.sensors import Sensors, torque_gain, torque_noise, torque_zero
from ..following.train import FollowedTrain
from .loss_table import LossTable

Array = NDArray[np.float64]

PARAMETERS = "friction_level", "torque_zero", "drag", "torque_gain", "law_torque", "law_speed"
F, B, D, G, F_T, F_W = range(len(PARAMETERS))
OWN = [0, 1, 2, 3, 5, 6]  # indices of these parameters in a `Memory`, which also has the inertia
UNSEEN = 10.0  # variance of inertia torques between rows at most, over that of the differences


class Row(NamedTuple):
    """One reading of every gearbox, in SI, (n,) each; NaN where a reading is missing."""

    input_torque: Array
    output_torque: Array
    input_speed: Array
    oil_temperature: Array
    acceleration: Array
    """Acceleration of the input [rad/s^2]."""


class SceneBalances(NamedTuple):
    """Balances of one row with the losses of the scene, (n,) each; without a filter."""

    residual: Array
    """Measured minus expected balance at the input [N m]; NaN without a reading."""
    torque: Array
    """Mean of the torques of both ends [N m]."""
    noise: Array
    """Variance that the noise of the sensors and the inertia explain [N^2 m^2]."""


class Innovations(NamedTuple):
    """Measured minus expected balances, (n,) each."""

    value: Array
    """Innovation at the input [N m]; NaN without a reading."""
    sd: Array
    """Expected standard deviation [N m]."""
    loss: Array
    """Loss torque of the scene [N m]."""
    scene: SceneBalances
    """The balances without the filter."""


@dataclass
class Balances:
    """Kalman filters of n gearboxes of one type.

    Args:
        train: gear train of the type.
        table: table of its losses.
        sensors: accuracy of the sensors.
        memory: how fast parameters may change.
        count: number of gearboxes.
    """

    train: FollowedTrain
    table: LossTable
    sensors: Sensors
    memory: Memory
    count: int
    x: Array = field(init=False)
    """Expected parameters, (n, 6)."""
    p: Array = field(init=False)
    """Their covariances, (n, 6, 6)."""

    def __post_init__(self) -> None:
        sensors, train = self.sensors, self.train
        self.mean = np.array([1.0, 0.0, 0.0, 0.0, 0.0, 0.0])
        self.sd = np.array(
            [
                sensors.friction, torque_zero(sensors, train),
                sensors.drag or DRAG * train.torque, torque_gain(sensors), *LAW,
            ]
        )  # fmt: skip
        noise = torque_noise(sensors, train)
        self._noise = noise[0] ** 2, (train.ratio * noise[1]) ** 2
        self._inertia = train.inertia if sensors.inertia is None else sensors.inertia
        self._fall, self._walk = self.memory.fall[OWN], self.memory.walk[OWN]
        self._weight = np.full(self.count, self._noise[1] / sum(self._noise))
        """Weight of the input in the mean torque of both ends, (n,)."""
        self.x = np.tile(self.mean, (self.count, 1))
        self.p = np.tile(np.diag(self.sd**2), (self.count, 1, 1))
        self.least = np.ones(self.count)
        """Variances of the balances over those of the sensors' noise, at least 1, (n,)."""
        self.excess = np.ones(self.count)
        """The same of the present innovations, at least `least`, (n,)."""

    def restart(self, which: NDArray[np.bool_]) -> None:
        """Reset parameters and covariances of some gearboxes to the priors.

        Args:
            which: mask of the gearboxes, (n,).
        """
        self.x[which], self.p[which] = self.mean, np.diag(self.sd**2)
        self.excess[which] = self.least[which]

    def widen(self, which: NDArray[np.bool_], measured: Array, stated: Array) -> None:
        """Restart some gearboxes with their measured scatter as noise of the balance.

        What accelerations can explain is an error of the input torque less the inertia torque. The
        rest is noise of both sensors in the ratio as stated.

        Args:
            which: mask of the gearboxes, (n,).
            measured: variances of the balances [N^2 m^2], (n,).
            stated: variances that the sensors and the inertia explain [N^2 m^2], (n,).
        """
        noise = sum(self._noise)
        added = measured[which] - stated[which]
        inertial = np.minimum(added, UNSEEN * (stated[which] - noise) / INERTIA**2)
        self.least[which] = 1.0 + added / noise
        self._weight[which] *= (noise + added - inertial) / (noise + added)
        self.restart(which)

    def reopen(self, which: NDArray[np.bool_]) -> None:
        """Add the prior variances of friction, zero and drag, after a step of the loss.

        Args:
            which: mask of the gearboxes, (n,).
        """
        for state in (F, B, D):
            self.p[which, state, state] += self.sd[state] ** 2

    def update(self, row: Row, step: float) -> Innovations:
        """Update the parameters with one reading of every gearbox.

        Args:
            row: the readings.
            step: time since the last row [s].

        Returns:
            The innovations.
        """
        self._predict(step)
        train, x = self.train, self.x
        turning = np.abs(row.input_speed) > STANDSTILL * train.speed
        driving = row.input_torque - self._inertia * row.acceleration
        driven = train.ratio * row.output_torque
        usable = np.isfinite(driving) & np.isfinite(driven) & turning
        speed = np.where(usable, row.input_speed, train.speed)
        measured_torque = np.where(usable, driving, train.torque)
        oil = np.where(np.isfinite(row.oil_temperature), row.oil_temperature, train.oil_temperature)
        sign = np.sign(speed)
        losses = self.table(measured_torque, speed, oil)
        balance = np.where(usable, driving + driven, np.nan)
        inertia_noise = (INERTIA * self._inertia * np.where(usable, row.acceleration, 0.0)) ** 2
        loss = losses.teeth + losses.rest
        scene = SceneBalances(
            balance - sign * loss,
            0.5 * (driving - driven),
            sum(self._noise) + inertia_noise,
        )
        phi, logarithms = self._friction(measured_torque, speed)
        expected_sum = (
            sign * (phi * losses.teeth + losses.rest + x[:, D])
            + x[:, B]
            + x[:, G] * measured_torque
        )
        # Mean of both ends, weighted by the inverse variances of their readings.
        torque = self._weight * measured_torque + (1.0 - self._weight) * (
            expected_sum - np.where(usable, driven, expected_sum - measured_torque)
        )
        losses = self.table(torque, speed, oil)
        phi, logarithms = self._friction(torque, speed)
        slope = np.stack(
            [
                sign * losses.teeth, np.ones(self.count), sign, torque,
                sign * losses.teeth * logarithms[0], sign * losses.teeth * logarithms[1],
            ], axis=1,
        )  # fmt: skip
        expected = sign * (phi * losses.teeth + losses.rest + x[:, D]) + x[:, B] + x[:, G] * torque
        noise = self.excess * sum(self._noise) + inertia_noise
        innovation = np.where(usable, driving + driven - expected, np.nan)
        sd = self._update(innovation, slope, noise, step)
        return Innovations(innovation, sd, loss, scene)

    def _friction(self, torque: Array, speed: Array) -> tuple[Array, tuple[Array, Array]]:
        """Friction level at operating points, and the logarithms of torque and speed, (n,) each."""
        log_torque = np.log(np.maximum(np.abs(torque) / self.train.torque, LEAST))
        log_speed = np.log(np.maximum(np.abs(speed) / self.train.speed, LEAST))
        x = self.x
        return x[:, F] + x[:, F_T] * log_torque + x[:, F_W] * log_speed, (log_torque, log_speed)

    def _predict(self, step: float) -> None:
        decay = np.exp(-step / self._fall)
        self.x = self.mean + decay * (self.x - self.mean)
        self.p *= np.outer(decay, decay)
        added_variance = (1.0 - decay**2) * self.sd**2 + self._walk**2 * step
        self.p[:, range(len(decay)), range(len(decay))] += added_variance

    def _update(self, innovation: Array, slope: Array, noise: Array, step: float) -> Array:
        """Scalar updates in Joseph's form, of the gearboxes whose reading passes the gate.

        Returned are the expected standard deviations of the innovations [N m], (n,).

        (1 - k h') P (1 - k h')' + R k k' = P - k a' - a k' + (h' a + R) k k', with a = P h. Sums
        are element by element, so that the bits of a gearbox do not depend on the others.
        """
        cross_covariance = _sum(self.p[:, :, k] * slope[:, k, None] for k in range(len(PARAMETERS)))
        variance = (
            _sum(slope[:, k] * cross_covariance[:, k] for k in range(len(PARAMETERS))) + noise
        )
        sd = np.sqrt(variance)
        score = innovation / sd
        accepted = np.abs(score) <= GATE  # false without a reading
        gain = np.where(accepted[:, None], cross_covariance / variance[:, None], 0.0)
        self.x = self.x + gain * np.where(accepted, innovation, 0.0)[:, None]
        cross = gain[:, :, None] * cross_covariance[:, None, :]
        square = variance[:, None, None] * (gain[:, :, None] * gain[:, None, :])
        self.p = self.p - (cross + np.swapaxes(cross, 1, 2)) + square
        weight = min(step / NOISE_MEMORY, 0.1)
        normalised_square = np.where(np.isfinite(score), np.minimum(score**2, GATE**2), 1.0)
        self.excess = np.maximum(
            self.least, self.excess * (1.0 + weight * (normalised_square - 1.0))
        )
        return np.asarray(sd)


def _sum(parts: Iterable[Array]) -> Array:
    """Sum of arrays, from the first to the last."""
    return reduce(np.add, parts)
