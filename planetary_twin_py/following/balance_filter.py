"""Extended Kalman filter of the torque balance between both ends of a gear train.

Measured are the torques at the input, T_m, and at the output, T_l, with the speed ratio i:

    T_m     = T + J a + n1
    i T_l   = -T + s (phi L(T, w, oil) + R(w, oil) + d) + b + g T + n2
    phi     = f + f_T ln(|T|/T0) + f_w ln(|w|/w0),   s = sign(w)

L and R are the loss torques of tooth friction and of all other losses in the scene, f is the
friction level, d a drag that is not in the scene, b the zero of both torque sensors, g the
difference of their gains, J the inertia, and a the acceleration. T is a state with process noise,
not a regressor, because its noise would bias the other states. f_T and f_w represent the deviation
of the actual friction law from that of the scene.

The update is in Joseph's form (Bucy and Joseph 1968, Filtering for Stochastic Processes, ch. 16).
The parameters are Gauss-Markov processes, which decay to their priors, or random walks.
"""

from __future__ import annotations

import copy
import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .loss_map import LossMap
from .sensors import Sensors, torque_gain, torque_noise, torque_zero
from .train import FollowedTrain

Array = NDArray[np.float64]

STATES = (
    "input_torque", "torque_rate", "friction_level", "torque_zero", "drag", "torque_gain",
    "inertia", "friction_over_torque", "friction_over_speed",
)  # fmt: skip
T, RATE, F, B, D, G, J, F_T, F_W = range(len(STATES))
PARAMETERS = slice(F, None)
OF_PARAMETERS = np.arange(F, len(STATES))
IDENTITY = np.eye(len(STATES))
WANDER = 0.025  # random walk of the torque per sqrt(s), over the torque of the scene
RATE_WANDER = 0.24  # [1/s] random walk of its rate per sqrt(s), over the torque of the scene
INERTIA = 0.1  # standard deviation over the inertia of the scene
DRAG = 5e-4  # standard deviation over the torque of the scene
LAW = 0.2, 0.3  # standard deviations of f_T and f_w
STANDSTILL = 0.01  # share of the speed of the scene below which the sign of the loss is unknown
LEAST = 0.02  # lower limit of torque and speed in the logarithms, over those of the scene
GATE = 5.0  # standard deviations above which an innovation is rejected
NOISE_MEMORY = 60.0  # [s] time constant of the estimated noise
GAP = 2.0  # [s] without a bin after which the torque is unknown
FAR = 10.0  # standard deviation of an unknown torque over the torque of the scene
FALL = 600.0  # [s] time constant with which the friction law decays to its prior
SLOW_FALL = 21_600.0  # [s] the same of the other parameters, see interval_coverage.py
USUAL = 2.0  # standard deviations from its prior beyond which a parameter shows the prior as narrow
CLEAR = 5.0  # standard deviations above which an acceleration is used for the inertia


class Measured(NamedTuple):
    """Means of one bin for the filter; NaN if a quantity was not measured."""

    time: float
    """Middle of the bin [s]."""
    input_torque: float
    """[N m]."""
    output_torque: float
    """[N m]."""
    counts: tuple[int, int]
    """Number of readings in the means of both torques."""
    speed: float
    """Speed of the input [rad/s]."""
    acceleration: float
    """Acceleration of the input [rad/s^2]."""
    acceleration_noise: float
    """Standard deviation of the acceleration [rad/s^2]."""
    oil_temperature: float
    """[K]."""


class Innovation(NamedTuple):
    """Measured minus expected sum of both torques, referred to the input."""

    value: float
    """[N m]."""
    sd: float
    """Its expected standard deviation [N m]."""
    gated: bool
    """Whether the gate rejects it."""


FRICTION, DRAGGING, ZERO, GAIN = (
    "friction", "drag", "zero of a torque sensor", "gain of a torque sensor",
)  # fmt: skip
CAUSES = FRICTION, DRAGGING, ZERO, GAIN  # of a step of the balance


class Balance(NamedTuple):
    """Measured minus expected sum of both torques of one bin, without an estimate of the torque."""

    value: float
    """[N m]."""
    sd: float
    """Standard deviation of the readings in it [N m]."""
    slope: Array
    """Derivatives of the expected balance over the parameters, (7,)."""
    added: Array
    """What each of `CAUSES` adds to the balance [N m], (4,): all friction of the teeth, a drag of
    1 N m, a zero of 1 N m, and a gain of 100 %."""


@dataclass(frozen=True)
class Memory:
    """How fast parameters may change."""

    fall: Array
    """Time constants of their decay to the priors [s], (7,); infinite: no decay."""
    walk: Array
    """Standard deviations of their random walks per sqrt(s), (7,)."""


def interval_memory() -> Memory:
    """Parameters decay to their priors: a model error must not be averaged to certainty."""
    fall = np.array([SLOW_FALL, SLOW_FALL, SLOW_FALL, SLOW_FALL, SLOW_FALL, FALL, FALL])
    return Memory(fall, np.zeros(7))


def alarm_memory(train: FollowedTrain) -> Memory:
    """Parameters change slowly, so that a step is detected before the filter has adapted to it.

    Args:
        train: gear train whose torque scales the random walk of the zero.
    """
    walk = np.array([2e-4, 3.2e-7 * train.torque, 0.0, 0.0, 0.0, 0.0, 0.0])
    return Memory(np.full(7, np.inf), walk)


@dataclass
class BalanceFilter:
    """Extended Kalman filter of the torque balance.

    Args:
        train: gear train between the torque sensors.
        losses: loss torques of its scene.
        sensors: accuracy of the sensors.
        memory: how fast parameters may change.
    """

    train: FollowedTrain
    losses: LossMap
    sensors: Sensors
    memory: Memory
    x: Array = field(init=False)
    """Expected state, (9,)."""
    p: Array = field(init=False)
    """Its covariance, (9, 9)."""
    prior: tuple[Array, Array] = field(init=False)
    """Mean and standard deviation of the parameters before any reading, (7,) each."""

    def __post_init__(self) -> None:
        sensors, train = self.sensors, self.train
        inertia = train.inertia if sensors.inertia is None else sensors.inertia
        mean = np.array([1.0, 0.0, 0.0, 0.0, inertia, 0.0, 0.0])
        sd = np.array(
            [
                sensors.friction, torque_zero(sensors, train), sensors.drag or DRAG * train.torque,
                torque_gain(sensors), INERTIA * (inertia or train.inertia), *LAW,
            ]
        )  # fmt: skip
        self.prior = mean, sd
        noise = torque_noise(sensors, train)
        self._noise = noise[0] ** 2, (train.ratio * noise[1]) ** 2
        self.restart()

    def restart(self) -> None:
        """Reset state and covariance to the priors."""
        mean, sd = self.prior
        self.x = np.concatenate([[0.0, 0.0], mean])
        self.p = np.diag(np.concatenate([[1.0, 1.0], sd]) ** 2)
        self._reset_torque()
        self._time: float | None = None
        self.excess = 1.0
        """Variance of the innovations over that of the sensors' noise, at least 1."""

    def reopen(self, size: float, slope: Array) -> None:
        """Let friction, zero, drag or gain alone explain a step of the balance.

        Each of them becomes as uncertain as the step requires, and at least as it was before any
        reading.

        Args:
            size: size of the step [N m].
            slope: derivatives of the balance over the parameters, (7,).
        """
        sd = self.prior[1]
        for state in (F, B, D, G):
            needed = abs(size) / max(abs(float(slope[state - F])), LEAST * float(sd[state - F]))
            self.p[state, state] += max(needed, float(sd[state - F])) ** 2

    def update(self, read: Measured) -> Innovation | None:
        """Update the state with one bin.

        Args:
            read: means of the bin.

        Returns:
            The innovation of the balance; None if one of the torques or the speed was not measured,
            or if the train was at rest.
        """
        step = 0.0 if self._time is None else max(read.time - self._time, 0.0)
        self._time = read.time
        self._predict(step)
        turning = abs(read.speed) > STANDSTILL * self.train.speed  # false if it is NaN
        if math.isfinite(read.input_torque) and turning:
            noise = self._noise[0] / read.counts[0]
            slope = np.zeros(len(STATES))
            slope[T] = 1.0
            if abs(read.acceleration) > CLEAR * read.acceleration_noise:
                slope[J] = read.acceleration  # a regressor whose noise would bias J otherwise
            expected = float(self.x[T] + self.x[J] * read.acceleration)
            noise += (float(self.x[J]) * read.acceleration_noise) ** 2
            self._update(slope, read.input_torque - expected, noise)
        if not (math.isfinite(read.input_torque) and math.isfinite(read.output_torque) and turning):
            return None
        return self._balance(read, step)

    def kept(self) -> BalanceFilter:
        """A copy with the present state, which later updates do not change."""
        copied = copy.copy(self)
        copied.x, copied.p = self.x.copy(), self.p.copy()
        return copied

    def balance(self, read: Measured) -> Balance:
        """Balance of the readings of one bin alone with the present parameters.

        Args:
            read: means of a bin with both torques and the speed.

        Returns:
            The balance. Its noise is independent of that of other bins.
        """
        inertia = float(self.x[J])
        torque = read.input_torque - inertia * read.acceleration
        expected, slope = self._expected(torque, read.speed, read.oil_temperature)
        slope[J] = read.acceleration
        noise = self._noise[1] / read.counts[1] + self._noise[0] / read.counts[0]
        noise = self.excess * noise + (inertia * read.acceleration_noise) ** 2
        parameters = slope[PARAMETERS]
        law = np.array([F, F_T, F_W])
        friction = float(slope[law] @ self.x[law])
        return Balance(
            self.train.ratio * read.output_torque - expected,
            math.sqrt(noise),
            parameters,
            np.array([friction, math.copysign(1.0, read.speed), 1.0, slope[G]]),
        )

    def loss_torque(self, speed: float, temperature: float) -> tuple[float, float]:
        """Estimate the loss torque at the input.

        Args:
            speed: speed of the input [rad/s].
            temperature: temperature of the oil [K].

        Returns:
            Loss torque and its standard deviation [N m].
        """
        expected, slope = self._expected(float(self.x[T]), speed, temperature)
        slope[T] += 1.0
        slope[[B, G]] = 0.0
        value = expected + float(self.x[T] - self.x[B] - self.x[G] * self.x[T])
        return value * math.copysign(1.0, speed), math.sqrt(max(float(slope @ self.p @ slope), 0.0))

    def _predict(self, step: float) -> None:
        if step == 0.0:
            return
        scale = self.train.torque
        if step > GAP:
            self._reset_torque()
        self.x[T] += step * self.x[RATE]
        self.p[T] += step * self.p[RATE]
        self.p[:, T] += step * self.p[:, RATE]
        self.p[T, T] += (WANDER * scale) ** 2 * step
        self.p[RATE, RATE] += (RATE_WANDER * scale) ** 2 * step
        mean, sd = self.prior
        decay = np.exp(-step / self.memory.fall)
        self.x[PARAMETERS] = mean + decay * (self.x[PARAMETERS] - mean)
        state_decay = np.ones(len(STATES))
        state_decay[PARAMETERS] = decay
        self.p *= state_decay[:, np.newaxis] * state_decay
        stationary_sd = np.maximum(sd, np.abs(self.x[PARAMETERS] - mean) / USUAL)
        added_variance = (1.0 - decay**2) * stationary_sd**2 + self.memory.walk**2 * step
        self.p[OF_PARAMETERS, OF_PARAMETERS] += added_variance

    def _reset_torque(self) -> None:
        self.x[RATE] = 0.0
        self.p[: RATE + 1], self.p[:, : RATE + 1] = 0.0, 0.0
        self.p[T, T] = self.p[RATE, RATE] = (FAR * self.train.torque) ** 2

    def _expected(self, torque: float, speed: float, temperature: float) -> tuple[float, Array]:
        """Expected i T_l at T = `torque`, and its derivatives over the states, (9,)."""
        train, x = self.train, self.x
        sign = math.copysign(1.0, speed)
        loss = self.losses(torque, speed, temperature)
        log_torque = math.log(max(abs(torque) / train.torque, LEAST))
        log_speed = math.log(max(abs(speed) / train.speed, LEAST))
        phi = float(x[F] + x[F_T] * log_torque + x[F_W] * log_speed)
        slope = np.zeros(len(STATES))
        slope[T] = -1.0 + x[G] + sign * phi * loss.slope * math.copysign(1.0, torque)
        slope[F], slope[F_T], slope[F_W] = (
            sign * loss.teeth, sign * loss.teeth * log_torque, sign * loss.teeth * log_speed,
        )  # fmt: skip
        slope[B], slope[D], slope[G] = 1.0, sign, torque
        expected = -torque + sign * (phi * loss.teeth + loss.rest + float(x[D]))
        return expected + float(x[B] + x[G] * torque), slope

    def _balance(self, read: Measured, step: float) -> Innovation:
        expected, slope = self._expected(float(self.x[T]), read.speed, read.oil_temperature)
        noise = self.excess * self._noise[1] / read.counts[1]
        noise += (self.excess - 1.0) * self._noise[0] / read.counts[0]
        innovation = self.train.ratio * read.output_torque - expected
        variance = float(slope @ self.p @ slope) + noise
        sd = math.sqrt(variance)
        gated = abs(innovation) > GATE * sd
        if not gated:
            self._update(slope, innovation, noise)
        weight = min(step / NOISE_MEMORY, 0.1)
        normalised_square = min(innovation**2 / variance, GATE**2)
        self.excess = max(1.0, self.excess * (1.0 + weight * (normalised_square - 1.0)))
        return Innovation(innovation, sd, gated)

    def _update(self, slope: Array, innovation: float, noise: float) -> None:
        """Scalar update in Joseph's form."""
        cross_covariance = self.p @ slope
        gain = cross_covariance / (float(slope @ cross_covariance) + noise)
        self.x = self.x + gain * innovation
        column = gain[:, np.newaxis]
        reduction = IDENTITY - column * slope
        self.p = reduction @ self.p @ reduction.T + noise * (column * gain)
        self.p = 0.5 * (self.p + self.p.T)
