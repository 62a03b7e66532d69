"""Estimates the losses of many gearboxes of one type from readings of a SCADA system."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..following.balance.balances import PARAMETERS, B, D, F, Measured
from ..following.balance.cusum import YEAR, Steps, limit
from ..following.balance.follower import IDENTIFIABLE
from ..following.balance.friction_remark import friction_remarks
from ..following.balance.monitor import DIFFERENCE, Monitor
from ..following.damage.rows import TORQUE_SD
from ..following.estimate import CONFIDENT
from ..following.sensors import Sensors
from ..scene import Scene
from ..scene.given import check_scene
from ..text.object_repr import brief
from .fleet_check import FleetCheck
from .fleet_damage import FleetDamage
from .scatter import Scatter

Array = NDArray[np.float64]

CHANNELS = ("input_torque", "output_torque", "input_speed", "oil_temperature")
TERM = 60.0  # [s] over which innovations are averaged: single readings are too noisy for 5 %
SLOWEST, FASTEST = 600.0, 0.1  # [s] limits of the time between two readings
MOST_STEPS = 3  # in close succession, after which the readings of a gearbox do not fit the scene
CLEAR = 3.0  # standard deviations of a minute's mean from which on a step is found within minutes
UNSEEN = 10.0  # variance of inertia torques between rows at most, over that of the differences
CLOSE = 3.0 * TERM  # [s] between two steps in close succession


class FleetEstimate(NamedTuple):
    """Estimate of one parameter of all gearboxes, (n,) each."""

    value: Array
    """Value in SI; NaN where the readings do not determine it."""
    low: Array
    """Lower end of the 95 % interval, in SI; NaN where there is no value."""
    high: Array
    """Upper end of the 95 % interval, in SI; NaN where there is no value."""


class FleetScatter(NamedTuple):
    """Scatter of the torque balances of all gearboxes in their first minutes, (n,) each.

    Where the noise of the sensors does not explain it, the measured scatter replaces that noise.
    """

    measured: Array
    """Standard deviation of the balance of one row [N m]; NaN before it is known."""
    stated: Array
    """The same as the noise of the sensors explains it [N m]."""
    excessive: NDArray[np.bool_]
    """Whether the noise of the sensors does not explain it."""
    step: Array
    """Smallest step of the loss torque that is found within minutes, over the mean loss torque of
    the scene at all readings."""


class FleetEvent(NamedTuple):
    """A step of the loss torque of one gearbox."""

    gearbox: int
    """Index of the gearbox."""
    since: float
    """Earliest time at which the step may have started [s]."""
    found: float
    """Time of its detection [s]."""
    size: float
    """Mean of the innovations since then [N m], at the input; positive: a larger loss. The step
    itself is larger, because the filter adapts to a part of it."""
    share: float
    """Size over the mean loss torque of the scene since then, with the same weights."""


@dataclass
class Fleet:
    """Estimates friction, drag and torque sensors of many gearboxes of one type.

    The table of losses is computed once. Each reading then costs a few array operations for all
    gearboxes together. The same readings give the same estimates to the last bit.

    Args:
        scene: scene of the type, with one input.
        count: number of gearboxes.
        period: time between two readings [s].
        sensors: accuracy of the torque sensors; noise is that of one row.
        fleet_size: number of gearboxes of the whole fleet, if these are a part of it; the whole
            fleet has one false alarm in a year.
        damage: counts the damage of the same gearboxes; None: it is not counted.

    Raises:
        SceneError: the scene has two inputs, or cannot be simulated.
        ValueError: the number or the period is out of range.
    """

    scene: Scene
    count: int
    period: float = 1.0
    sensors: Sensors = field(default_factory=Sensors)
    fleet_size: int | None = None
    damage: FleetDamage | None = None
    events: list[FleetEvent] = field(init=False, default_factory=list)
    """Detected steps, in the order of their detection."""

    def __post_init__(self) -> None:
        check_scene(self.scene)
        if self.count < 1:
            raise ValueError(f"count = {self.count}: must be at least 1")
        if not FASTEST <= self.period <= SLOWEST:
            raise ValueError(
                f"period = {self.period!r} s: must be within {FASTEST:g} and {SLOWEST:g}"
            )
        interval = (self.fleet_size or self.count) * YEAR
        alarm = limit(interval, max(self.period, TERM)), TERM
        self._monitor = Monitor(self.scene, self.sensors, self.period, self.count, *alarm)
        self.train, self.table = self._monitor.train, self._monitor.losses
        self._scene_filter = self._monitor.alarms.kept()  # as the scene has it
        self._scatter = Scatter(self.count)
        self._check = FleetCheck(self.scene, self.table, self.sensors, self.period, self.count)
        self._time, self._speed = math.nan, np.full(self.count, math.nan)
        self._oil = np.full(self.count, self.train.oil_temperature)
        self.readings = np.zeros(self.count, dtype=np.int64)
        """Number of balances that were used, (n,)."""
        self.misfits = np.zeros(self.count, dtype=bool)
        """Whether the readings do not fit the scene, (n,): the loss has stepped three times in
        close succession, because units, signs or gains are wrong, or the scene is another one.
        Such a gearbox has no estimates, and no further events."""
        self.missing = np.zeros(self.count, dtype=np.int64)
        """Number of rows without a torque or the speed, (n,)."""
        self.first_missing = np.full(self.count, math.nan)
        """Time of the first of them [s], (n,); NaN if there is none."""
        self._losses = np.zeros(self.count)  # [N m] sum of the scene's at all balances
        self._balances = np.zeros(self.count)  # number of them
        self._last_torque = np.full(self.count, self.train.torque)
        self._last_speed = np.full(self.count, self.train.speed)
        self._last_step_times = np.full(self.count, -math.inf)  # [s]
        self._close_steps = np.zeros(self.count, dtype=np.int64)  # in close succession

    def add(self, time: float, readings: Mapping[str, Array]) -> None:
        """Add one reading of every gearbox.

        Args:
            time: time of the readings [s], later than that of the last ones.
            readings: readings by channel of `CHANNELS`, in SI with the signs of gearbox_state, (n,)
                each; NaN where a reading is missing. `input_torque_std` is used for damage.

        Raises:
            ValueError: a channel is missing or has another length, or time does not increase.
        """
        row = {}
        for name in CHANNELS:
            values = np.asarray(readings.get(name, np.nan), dtype=float)
            if name == "oil_temperature" and values.ndim == 0:
                values = np.full(self.count, math.nan)
            if values.shape != (self.count,):
                raise ValueError(f"{name}: must have {self.count} values, one for each gearbox")
            row[name] = values.copy()
        if time <= self._time:
            raise ValueError(f"time = {time:g} s: must be after {self._time:g} s")
        step = self.period if math.isnan(self._time) else time - self._time
        row = self._check.judge(time, row)
        acceleration = self._acceleration(row["input_speed"], step)
        self._check.leave_out_torques(time, row, acceleration, self._oil)
        if self.damage is not None:
            sd = np.broadcast_to(readings.get(TORQUE_SD, np.nan), self.count)
            self.damage.add(time, row | {TORQUE_SD: sd})
        speed = row["input_speed"]
        self._time, self._speed = time, speed
        oil = row["oil_temperature"]
        self._oil = np.where(np.isfinite(oil), oil, self._oil)
        self._note_missing(time, row)
        reading = Measured(
            time, row["input_torque"], row["output_torque"], np.ones((2, 1)), speed, acceleration,
            DIFFERENCE * np.abs(acceleration), self._oil,
        )  # fmt: skip
        self._monitor.cusum.waiting = ~self._scatter.known
        found = self._monitor.add(reading)
        has_balance = np.isfinite(found.balances.value)
        self.readings += has_balance
        self._losses += np.where(has_balance, found.balances.loss, 0.0)
        self._balances += has_balance
        self._alarm(time, found.steps)
        if not self._scatter.known.all():
            self._widen(self._scatter.add(time, self._scene_filter.balances(reading)))

    def _acceleration(self, speed: Array, step: float) -> Array:
        """Accelerations of the inputs since the last row [rad/s^2], (n,); 0 where unknown."""
        change = speed - self._speed
        return np.where(np.isfinite(change), change / step, 0.0)

    def finish(self) -> None:
        """Judge the last readings, at the end of a table."""
        self._check.finish()
        self._widen(self._scatter.finish())

    @property
    def faults(self) -> Mapping[int, str]:
        """Channel, value and correction by index of a gearbox whose readings contradict the scene.

        Units and signs are checked after 10 rows, and then after ever more, up to 640. Such a
        gearbox has no estimates.
        """
        return self._check.faults

    def remarks(self, gearbox: int) -> tuple[str, ...]:
        """Torques and speeds whose unit may be wrong, and a doubtful friction level.

        Args:
            gearbox: index of the gearbox.

        Returns:
            A line for each.
        """
        level, one = self.estimate("friction_level"), [gearbox]
        low, value, high = (float(v[gearbox]) for v in (level.low, level.value, level.high))
        losses = self.table(self._last_torque[one], self._last_speed[one], self._oil[one])
        doubtful = friction_remarks(low, value, high, float(losses.teeth[0]))  # none of NaN
        return (*self._check.remarks(gearbox), *doubtful)

    @property
    def scatter(self) -> FleetScatter:
        """Scatter of the balances of all gearboxes, and the steps that it hides."""
        kept, rows = self._scatter, max(TERM / self.period, 1.0)
        loss = np.where(self._balances > 0.0, self._losses, math.nan) / self._balances.clip(1.0)
        used = np.where(kept.excessive, kept.sd, kept.stated)  # as noise of the balances
        step = CLEAR * used / math.sqrt(rows) / loss
        return FleetScatter(kept.sd.copy(), kept.stated.copy(), kept.excessive.copy(), step)

    @property
    def fits(self) -> NDArray[np.bool_]:
        """Whether the readings fit the scene, (n,): neither `misfits` nor `faults`."""
        fits = ~self.misfits
        fits[list(self.faults)] = False
        return fits

    def _widen(self, which: NDArray[np.bool_]) -> None:
        """Start some gearboxes from their priors, with their measured scatter as noise."""
        if not which.any():
            return
        self._monitor.widen(which, self._measured_noise(), self._time)
        self.readings[which] = 0

    def _measured_noise(self) -> Array:
        """Variances of both torques that explain the measured scatter [N^2 m^2], (2, n).

        What accelerations can explain is an error of the input torque less the inertia torque. The
        rest is noise of both sensors in the ratio as stated.
        """
        measured, stated = self._scatter.sd**2, self._scatter.stated**2
        noise = self._scene_filter.noise
        added = measured - stated
        inertial = np.minimum(added, UNSEEN * (stated - noise.sum(axis=0)) / DIFFERENCE**2)
        return noise * (1.0 + (added - inertial) / noise.sum(axis=0)) + [inertial, 0.0 * inertial]

    def _note_missing(self, time: float, row: Mapping[str, Array]) -> None:
        """Count the rows without a balance, and keep the last torques and speeds."""
        torque, speed = row["input_torque"], row["input_speed"]
        missing = ~np.isfinite(torque + row["output_torque"] + speed)
        self.missing += missing
        self.first_missing[missing & np.isnan(self.first_missing)] = time
        self._last_torque = np.where(missing, self._last_torque, torque)
        self._last_speed = np.where(missing, self._last_speed, speed)

    def _alarm(self, time: float, steps: Steps) -> None:
        fits = ~self.misfits[steps.gearbox]
        self._note_misfits(time, steps.gearbox)
        gearbox, since, size, share = (values[fits] for values in steps)
        if not len(gearbox):
            return
        direction = np.sign(self._last_speed[gearbox])
        for index, begin, *sizes in zip(
            gearbox, since, direction * size, direction * share, strict=True
        ):
            self.events.append(FleetEvent(int(index), float(begin), time, *map(float, sizes)))
        mask = np.zeros(self.count, dtype=bool)
        mask[gearbox] = True
        causes = np.isin(np.arange(len(PARAMETERS)), [F, B, D])
        self._monitor.alarms.restart(mask)
        self._monitor.intervals.reopen(mask, np.where(causes, self._monitor.intervals.sd, 0.0))

    def _note_misfits(self, time: float, gearbox: NDArray[np.int64]) -> None:
        """Count the steps of each gearbox in close succession."""
        close = time - self._last_step_times[gearbox] <= max(CLOSE, 3.0 * self.period)
        self._close_steps[gearbox] = np.where(close, self._close_steps[gearbox] + 1, 1)
        self._last_step_times[gearbox] = time
        self.misfits |= self._close_steps >= MOST_STEPS

    def estimate(self, name: str) -> FleetEstimate:
        """Estimate of one parameter for all gearboxes.

        Args:
            name: friction_level, torque_zero, drag or torque_gain.

        Returns:
            Values and 95 % intervals; NaN where the standard deviation is above half of the prior
            one, and where the readings do not fit the scene. The interval of the friction level
            includes the error of the table.

        Raises:
            ValueError: there is no such parameter.
        """
        if name not in PARAMETERS[:4]:
            raise ValueError(f"{name!r}: must be one of {', '.join(PARAMETERS[:4])}")
        state, filters = PARAMETERS.index(name), self._monitor.intervals
        sd = np.sqrt(np.maximum(filters.p[:, state, state], 0.0))
        known = (sd < IDENTIFIABLE * filters.sd[state]) & self.fits
        if state == F:
            sd = np.hypot(sd, self.table.error * filters.x[:, F] / CONFIDENT)
        value = np.where(known, filters.x[:, state], math.nan)
        return FleetEstimate(value, value - CONFIDENT * sd, value + CONFIDENT * sd)

    def __repr__(self) -> str:
        """One line."""
        how = f"{self.count} gearboxes", f"period {self.period:g} s", f"{len(self.events)} events"
        return brief(self, self.scene.name, *how)
