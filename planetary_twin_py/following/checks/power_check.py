"""Leaves out torques that cannot belong together: the cable of a sensor, or a wild reading.

The torques of both shafts differ by the loss and the inertia. A sensor that drops out, or shows
another value for a moment, changes this balance by a share of the torque that no change of the loss
reaches, or that comes and goes at once. A change of the gearbox stays.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..arrival.bins import Bin, Mean
from ..channels.all import LOADED, MOVING, OIL, TORQUES
from ..loss_map import LossMap
from ..sensors import Sensors, inertia_between, torque_errors
from ..train import FollowedTrain
from .contradictions import INERTIAL, MOST
from .left_out import LeftOut

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

LEAST = -0.15  # share of the torque that is lost
NOISY = 6.0  # standard deviations of the balance that are no change
CHANGE = 0.1  # share of the torque; a balance that changes by more must stay for `WAIT`
WAIT = 1.0  # [s]
IMPOSSIBLE = "both torques show a loss that no gearbox has"
BRIEF = "both torques balance otherwise for less than a second"
DEAD = 0.1  # share of the other torque below which one is that of a sensor without signal


class Balanced(NamedTuple):
    """Torque balances of some readings, in any shape."""

    lost: Array
    """Loss torque at the input [N m]; NaN where it is not comparable."""
    size: Array
    """Larger torque of both, at the input [N m]."""
    dead: Mask
    """Whether one of them is exactly 0."""

    @property
    def doubtful(self) -> Mask:
        """Where only a gearbox with large losses loses so much; false where not comparable."""
        return np.asarray(self.lost > MOST * self.size)

    def impossible(self, loss: Array) -> Mask:
        """Where no change of the gearbox explains the balance; false where it is not comparable.

        `loss` is that of the scene at the input where it is `doubtful` [N m], same shape.
        """
        large = self.doubtful & (self.dead | (self.lost > loss + MOST * self.size))
        return np.asarray(large | (self.lost < LEAST * self.size))


def balance(
    train: FollowedTrain, torques: tuple[Array, Array], speed: Array, inertial: Array
) -> Balanced:
    """Balance of both torques [N m], any shape, at the speed of the input [rad/s].

    `inertial` is the torque for the acceleration of the train, at the input [N m].
    """
    driven = train.ratio * torques[1]
    size = np.maximum(np.abs(torques[0]), np.abs(driven))
    comparable = (size > LOADED * train.torque) & (np.abs(speed) > MOVING * train.speed)
    comparable &= np.abs(inertial) <= INERTIAL * size
    lost = np.sign(speed) * (torques[0] + driven - inertial)
    dead = (torques[0] == 0.0) | (torques[1] == 0.0)
    return Balanced(np.where(comparable, lost, np.nan), size, dead)


def wrong_torques(
    train: FollowedTrain, torques: tuple[Array, Array], usual: tuple[Array, Array]
) -> tuple[Mask, Mask]:
    """Which of the torques at input and output that do not belong together are wrong: one, or both.

    `usual` are the last ones that belonged together, NaN if there are none.
    """
    sizes = np.abs(torques[0]), np.abs(train.ratio * torques[1])
    changes = (
        np.abs(torques[0] - usual[0]),
        np.abs(train.ratio * (torques[1] - usual[1])),
    )
    dead = sizes[0] < DEAD * sizes[1], sizes[1] < DEAD * sizes[0]
    changed = changes[0] > 3.0 * changes[1], changes[1] > 3.0 * changes[0]
    input_only = changed[0] | (dead[0] & ~changed[1])
    output_only = changed[1] | (dead[1] & ~changed[0])
    return np.asarray(~output_only), np.asarray(~input_only)


class PowerCheck:
    """Judges bins of readings in the order of time, and adds what it leaves out to `left_out`."""

    def __init__(
        self, train: FollowedTrain, losses: LossMap, sensors: Sensors, period: float,
        left_out: LeftOut,
    ) -> None:  # fmt: skip
        self._train, self._losses, self._period = train, losses, period
        self._inertia = inertia_between(sensors, train)
        self._oil, (at_input, at_output) = train.oil_temperature, torque_errors(sensors, train)
        self._noise = at_input.noise**2, (train.ratio * at_output.noise) ** 2
        self._left_out = left_out
        self._level: float | None = None  # share of the torque that is lost
        self._usual = math.nan, math.nan  # torques [N m]
        self._held: list[tuple[Bin, float, bool]] = []  # with share, and whether it is impossible
        self._fails = False
        self._wrong: Sequence[str] = ()  # torques that were left out last
        self._speed = math.nan, math.nan  # time [s] and speed of the last bin

    def add(self, new: Bin) -> Iterator[Bin]:
        """Add a bin; return the judged bins, in order, without the torques that are left out."""
        share, far, impossible = self._judge(new)
        if not far and not math.isnan(share):
            yield from self._release(True)
            self._level, self._fails = share, False
            self._usual = new.means[TORQUES[0]].value, new.means[TORQUES[1]].value
            yield new
        elif far and impossible and self._fails:
            self._held.append((new, share, impossible))
            yield from self._release(True)
        elif far or self._held:
            self._held.append((new, share, impossible))
            if (new.number - self._held[0][0].number + 1) * self._period >= WAIT - 1e-9:
                yield from self.finish()
        elif self._fails:  # too little load to show whether the signal is back
            yield self._without(new, self._wrong, IMPOSSIBLE)
        else:
            yield new

    def finish(self) -> Iterator[Bin]:
        """Judge the bins that are held back."""
        judged = [(share, bad) for _, share, bad in self._held if not math.isnan(share)]
        fails = 2 * sum(bad for _, bad in judged) > len(judged)
        if judged and not fails:
            self._level = [share for share, bad in judged if not bad][-1]
        self._fails = fails
        yield from self._release(fails)

    def _judge(self, new: Bin) -> tuple[float, bool, bool]:
        """Share of the torque that is lost, whether it is far from usual, and impossible."""
        torques = new.means.get(TORQUES[0]), new.means.get(TORQUES[1])
        speed, acceleration = self._turning(new)
        self._oil = new.means[OIL].value if OIL in new.means else self._oil
        if torques[0] is None or torques[1] is None:
            return math.nan, False, False
        values = np.array([torques[0].value]), np.array([torques[1].value])
        inertial = np.array([self._inertia * acceleration])
        found = balance(self._train, values, np.array([speed]), inertial)
        lost, size = float(found.lost[0]), float(found.size[0])
        if math.isnan(lost):
            return math.nan, False, False
        loss = math.nan
        if found.doubtful[0]:
            loss = float(self._losses(torques[0].value, speed, self._oil).total)
        impossible = bool(found.impossible(np.array([loss]))[0])
        sd = math.sqrt(self._noise[0] / torques[0].readings + self._noise[1] / torques[1].readings)
        limit = CHANGE * max(size, self._train.torque) + NOISY * sd
        far = impossible if self._level is None else abs(lost - self._level * size) > limit
        return lost / size, far or impossible, impossible

    def _turning(self, new: Bin) -> tuple[float, float]:
        """Speed [rad/s] and acceleration [rad/s^2] of the input."""
        mean, factor = new.speed(self._train.ratio)
        if mean is None:
            return math.nan, 0.0
        time, speed = (new.number + 0.5) * self._period, mean.value * factor
        before, self._speed = self._speed, (time, speed)
        slope = mean.slope * factor
        if not math.isfinite(slope):
            slope = (speed - before[1]) / (time - before[0])
        return speed, slope if math.isfinite(slope) else 0.0

    def _release(self, omit: bool) -> Iterator[Bin]:
        """Return the bins that are held back, without their torques if these are left out."""
        held, self._held = self._held, []
        reason = IMPOSSIBLE if self._fails or any(bad for *_, bad in held) else BRIEF
        for one, share, impossible in held:
            if omit and math.isnan(share) and self._fails:
                yield self._without(one, self._wrong, reason)
            elif math.isnan(share) or not (omit or impossible):
                yield one
            else:
                self._wrong = self._wrong_in(one)
                yield self._without(one, self._wrong, reason)

    def _wrong_in(self, one: Bin) -> list[str]:
        """Torques of a bin that are wrong."""
        values = tuple(np.array(one.means[name].value) for name in TORQUES)
        usual = tuple(map(np.array, self._usual))
        wrong = wrong_torques(self._train, (values[0], values[1]), (usual[0], usual[1]))
        return [name for name, is_wrong in zip(TORQUES, wrong, strict=True) if is_wrong]

    def _without(self, one: Bin, names: Sequence[str], reason: str) -> Bin:
        kept: dict[str, Mean] = dict(one.means)
        for name in names:
            if mean := kept.pop(name, None):
                self._left_out.add_bin(name, reason, one.number, mean, self._period)
        return Bin(one.number, kept)
