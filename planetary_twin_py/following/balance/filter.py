"""Kalman filters of the torque balances of gearboxes of one type, in arrays over the gearboxes.

Measured are the torques at the input, T_m, and at the output, T_l, with the speed ratio i:

    T_m + i T_l = J a + s (phi L(T, w, oil) + R(w, oil) + d) + b + g T + n
    phi         = f + f_T ln(|T|/T0) + f_w ln(|w|/w0),   s = sign(w)

L and R are the loss torques of tooth friction and of all other losses in the scene, f is the
friction level, d a drag that is not in the scene, b the zero of both torque sensors, g the
difference of their gains, J the inertia, and a the acceleration. f_T and f_w represent the
deviation of the actual friction law from that of the scene.

T is the mean of both ends, weighted by the inverse variances of their readings. Its error then does
not correlate with the noise n of the balance; a correlation would bias the parameters (errors in
variables, Fuller 1987, Measurement Error Models).

The update is in Joseph's form (Bucy and Joseph 1968, Filtering for Stochastic Processes, ch. 16).
The parameters are Gauss-Markov processes, which decay to their priors, or random walks. All sums
are element by element, so that the bits of a gearbox do not depend on the others.
"""

from __future__ import annotations

import copy
import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..loss_map import LossMap
from ..sensors import Sensors, balance_errors, inertia_between, torque_errors
from ..train import FollowedTrain
from .balances import (
    F_T,
    F_W,
    PARAMETERS,
    B,
    Balances,
    D,
    F,
    G,
    InnovationArrays,
    J,
    Measured,
)

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

DIAGONAL = np.arange(len(PARAMETERS))
INERTIA = 0.1  # standard deviation over the inertia of the scene
DRAG = 7.5e-4  # standard deviation over the torque of the scene: bearings may add to it
LAW = 0.2, 0.3  # standard deviations of f_T and f_w
STANDSTILL = 0.01  # share of the speed of the scene below which the sign of the loss is unknown
LEAST = 0.02  # lower limit of torque and speed in the logarithms, over those of the scene
GATE = 5.0  # standard deviations above which an innovation is rejected
NOISE_MEMORY = 60.0  # [s] time constant of the estimated noise
WANDER = 0.025  # random walk of an unmeasured torque per sqrt(s), over the torque of the scene
GAP = 2.0  # [s] without a measured torque after which it is unknown
LAW_FALL = 600.0  # [s] time constant with which the friction law decays to its prior
ZERO_FALL = 1200.0  # [s] the same of zero and drag
SLOW_FALL = 3600.0  # [s] the same of friction level, gain and inertia; see hours_coverage.py
USUAL = 2.0  # standard deviations from its prior beyond which a parameter shows the prior as narrow
CLEAR = 5.0  # standard deviations above which an acceleration is used for the inertia


@dataclass(frozen=True)
class Memory:
    """How fast parameters may change."""

    fall: Array
    """Time constants of their decay to the priors [s], (7,); infinite: no decay."""
    walk: Array
    """Standard deviations of their random walks per sqrt(s), (7,)."""


def interval_memory() -> Memory:
    """Parameters decay to their priors: a model error must not be averaged to certainty.

    Nor must a zero that drifts, or a friction law that is another one: with 6 h of memory, the
    level of a plant with bearings on its planets was outside its interval in one run of five.
    """
    fall = np.full(len(PARAMETERS), SLOW_FALL)
    fall[[B, D]], fall[[F_T, F_W]] = ZERO_FALL, LAW_FALL
    return Memory(fall, np.zeros(7))


def alarm_memory(train: FollowedTrain) -> Memory:
    """Parameters change slowly, so that a step is detected before the filter has adapted to it.

    Zeros drift with the temperature of a day. A slower zero leaves the drift to the friction, which
    is then wrong at other torques: with 3e-7, innovations of varied duty are 0.4 standard
    deviations from 0 after three hours, almost the `KAPPA` of a step.
    """
    walk = np.array([1e-4, 1.6e-6 * train.torque, 0.0, 0.0, 0.0, 0.0, 0.0])
    return Memory(np.full(7, np.inf), walk)


@dataclass
class BalanceFilter:
    """Kalman filters of the torque balances of n gearboxes of one type."""

    train: FollowedTrain
    losses: LossMap
    sensors: Sensors
    memory: Memory
    count: int = 1
    x: Array = field(init=False)
    """Expected parameters, (n, 7)."""
    p: Array = field(init=False)
    """Their covariances, (n, 7, 7)."""
    mean: Array = field(init=False)
    """Means of the parameters before any reading, (7,)."""
    sd: Array = field(init=False)
    """Their standard deviations, (7,)."""
    noise: Array = field(init=False)
    """Variances of one reading of both torques, referred to the input [N^2 m^2], (2, n)."""

    def __post_init__(self) -> None:
        sensors, train = self.sensors, self.train
        errors = balance_errors(sensors, train)
        inertia = inertia_between(sensors, train)
        self.mean = np.array([1.0, 0.0, 0.0, 0.0, inertia, 0.0, 0.0])
        self.sd = np.array(
            [
                sensors.friction, errors.zero, sensors.drag or DRAG * train.torque,
                errors.gain, INERTIA * (inertia or train.inertia), *LAW,
            ]
        )  # fmt: skip
        noise = np.array([one.noise for one in torque_errors(sensors, train)]) * [1.0, train.ratio]
        self.noise = np.tile(noise[:, None] ** 2, self.count)
        self.x = np.tile(self.mean, (self.count, 1))
        self.p = np.tile(np.diag(self.sd**2), (self.count, 1, 1))
        self.excess = np.ones(self.count)
        """Variances of the innovations over those of the sensors' noise, at least 1, (n,)."""
        self.torque = np.zeros(self.count)
        """Torques at the input without that of the inertia [N m], (n,)."""
        self.torque_sd = np.full(self.count, math.inf)
        """Their standard deviations [N m], (n,); infinite where the torque is not known."""
        self._measured_at = np.full(self.count, -math.inf)
        self._time = math.nan

    def restart(self, which: Mask) -> None:
        """Reset parameters and covariances of a mask of gearboxes, (n,), to the priors."""
        self.x = np.where(which[:, None], self.mean, self.x)
        self.p = np.where(which[:, None, None], np.diag(self.sd**2), self.p)
        self.excess = np.where(which, 1.0, self.excess)

    def widen(self, which: Mask, noise: Array) -> None:
        """Restart some gearboxes with another noise of their torques.

        It is the variances of one reading of both torques, referred to the input [N^2 m^2], (2, n).
        """
        self.noise = np.where(which, noise, self.noise)
        self.restart(which)

    def reopen(self, which: Mask, sd: Array) -> None:
        """Add standard deviations, (7,), to those of the parameters of some gearboxes."""
        self.p = self.p + which[:, None, None] * np.diag(sd**2)

    def kept(self) -> BalanceFilter:
        """A copy with the present state, which later updates do not change."""
        return copy.copy(self)  # all arrays are replaced, and none is changed

    def update(self, read: Measured) -> tuple[InnovationArrays, Balances]:
        """Update the parameters; return innovations, and balances with those before."""
        step = max(read.time - self._time, 0.0) if math.isfinite(self._time) else 0.0
        self._time = read.time
        self._predict(step)
        balances = self.balances(read)
        self._note_torque(read, balances)
        value, slope = balances.value, balances.slope
        cross_covariance = (self.p * slope[:, None, :]).sum(-1)
        variance = (slope * cross_covariance).sum(-1) + balances.sd**2
        sd = np.sqrt(variance)
        score = value / sd
        accepted = np.abs(score) <= GATE  # false without a reading
        gain = np.where(accepted[:, None], cross_covariance / variance[:, None], 0.0)
        self.x = self.x + gain * np.where(accepted, value, 0.0)[:, None]
        # (1 - k h') P (1 - k h')' + R k k' = P - k a' - a k' + (h' a + R) k k', with a = P h
        cross = gain[:, :, None] * cross_covariance[:, None, :]
        square = variance[:, None, None] * (gain[:, :, None] * gain[:, None, :])
        self.p = self.p - (cross + np.swapaxes(cross, 1, 2)) + square
        weight = min(step / NOISE_MEMORY, 0.1)
        has_reading = np.isfinite(score)
        normalised_square = np.where(has_reading, np.minimum(score**2, GATE**2), 1.0)
        self.excess = np.maximum(1.0, self.excess * (1.0 + weight * (normalised_square - 1.0)))
        return InnovationArrays(value, sd, has_reading & ~accepted), balances

    def balances(self, read: Measured) -> Balances:
        """Balances with the present parameters: of every gearbox, or many of the only one.

        Their noises are independent.
        """
        train, x = self.train, self.x
        acceleration, acceleration_sd = read.acceleration, read.acceleration_noise
        noise = self.excess * self.noise / read.counts
        noise[0] += (x[:, J] * acceleration_sd) ** 2
        driving = read.input_torque - x[:, J] * acceleration
        driven = train.ratio * read.output_torque
        turning = np.abs(read.speed) > STANDSTILL * train.speed  # false if it is NaN
        usable = np.isfinite(driving + driven) & turning
        speed = np.where(usable, read.speed, train.speed)
        at_input = np.where(usable, driving, train.torque)
        expected = self._expected(at_input, speed, read.oil_temperature)[0]
        at_output = expected - np.where(usable, driven, expected - at_input)
        weight = noise[1] / (noise[0] + noise[1])
        torque = weight * at_input + (1.0 - weight) * at_output
        expected, slope, loss = self._expected(torque, speed, read.oil_temperature)
        # An acceleration is a regressor, whose noise would bias the inertia otherwise.
        slope[:, J] = np.where(np.abs(acceleration) > CLEAR * acceleration_sd, acceleration, 0.0)
        friction = (slope[:, [F, F_T, F_W]] * x[:, [F, F_T, F_W]]).sum(-1)
        return Balances(
            np.where(usable, driving + driven - expected, math.nan),
            np.sqrt(noise[0] + noise[1]),
            slope,
            friction,
            torque,
            np.sqrt(noise[0] * weight),
            loss,
        )

    def loss_torque(self, speed: Array, temperature: Array) -> tuple[Array, Array]:
        """Loss torques at the inputs and their standard deviations [N m], (n,)."""
        expected, slope, _ = self._expected(self.torque, speed, temperature)
        own = (slope[:, [B, G]] * self.x[:, [B, G]]).sum(-1)
        slope[:, [B, G]] = 0.0
        over_torque = slope[:, F] * self.x[:, F] / np.maximum(np.abs(self.torque), 1e-9)
        sd = np.hypot(self._sd_along(slope), over_torque * self.torque_sd)
        return (expected - own) * np.sign(speed), sd

    def apparent_level(self) -> tuple[Array, Array]:
        """Friction levels and their deviations, (n,), if they alone explained the balances.

        Zero, drag and gain are hardly distinguished from friction, but their sum is well known.
        """
        train = self.train
        points = np.outer([train.torque, train.speed, train.oil_temperature], np.ones(self.count))
        expected, slope, loss = self._expected(points[0], points[1], points[2])
        teeth = slope[:, F]
        return (expected - loss) / teeth + 1.0, self._sd_along(slope) / teeth

    def uncertainty(self, state: int) -> float:
        """Standard deviation of a parameter of the first gearbox."""
        sd = math.sqrt(max(float(self.p[0, state, state]), 0.0))
        if state == F:  # the loss of the scene is as uncertain as the torque
            sd = math.hypot(sd, float(self.x[0, F] * self.x[0, G]))
        return sd

    def _sd_along(self, slope: Array) -> Array:
        """Standard deviations of linear functions of the parameters, (n,)."""
        variance = (slope * (self.p * slope[:, None, :]).sum(-1)).sum(-1)
        return np.asarray(np.sqrt(np.maximum(variance, 0.0)))

    def _predict(self, step: float) -> None:
        decay = np.exp(-step / self.memory.fall)
        self.x = self.mean + decay * (self.x - self.mean)
        stationary_sd = np.maximum(self.sd, np.abs(self.x - self.mean) / USUAL)
        self.p = self.p * (decay[:, None] * decay)
        self.p[:, DIAGONAL, DIAGONAL] += (1.0 - decay**2) * stationary_sd**2
        self.p[:, DIAGONAL, DIAGONAL] += self.memory.walk**2 * step

    def _expected(self, torque: Array, speed: Array, temperature: Array) -> tuple[Array, ...]:
        """Expected sums of both torques without inertia, their derivatives, and losses [N m]."""
        x, sign = self.x, np.sign(speed)
        losses = self.losses(torque, speed, temperature)
        log_torque = np.log(np.maximum(np.abs(torque) / self.train.torque, LEAST))
        log_speed = np.log(np.maximum(np.abs(speed) / self.train.speed, LEAST))
        phi = x[:, F] + x[:, F_T] * log_torque + x[:, F_W] * log_speed
        expected = sign * (phi * losses.teeth + losses.rest + x[:, D]) + x[:, B] + x[:, G] * torque
        friction, one = sign * losses.teeth, np.ones(len(torque))
        parts = friction, one, sign, torque, 0.0 * one, friction * log_torque, friction * log_speed
        return expected, np.stack(parts, axis=1), losses.total

    def _note_torque(self, read: Measured, balances: Balances) -> None:
        """Keep the torque of both ends or of the input; without one, it is ever less certain."""
        turning = np.abs(read.speed) > STANDSTILL * self.train.speed
        both, input_ = np.isfinite(balances.value), turning & np.isfinite(read.input_torque)
        at_input = read.input_torque - self.x[:, J] * read.acceleration
        input_sd = np.sqrt(self.noise[0] / read.counts[0])
        self._measured_at = np.where(input_, read.time, self._measured_at)
        since = read.time - self._measured_at
        wander = np.where(since > GAP, math.inf, WANDER * self.train.torque * np.sqrt(since))
        self.torque = np.select([both, input_], [balances.torque, at_input], self.torque)
        self.torque_sd = np.select(
            [both, input_], [balances.torque_sd, input_sd], np.hypot(input_sd, wander)
        )
