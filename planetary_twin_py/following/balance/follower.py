"""Estimates the loss of a gearbox from torques and speeds at its input and output."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ...scene import Scene
from ..arrival.bins import Bin, Counters, Mean
from ..checks.checked_bins import PERIOD, CheckedBins
from ..estimate import Estimate, Event, estimated, not_identifiable
from ..sensors import Sensors
from ..train import followed_train
from ..turning import Turning
from .balances import PARAMETERS, B, D, F, G, Innovation, J, Measured
from .filter import STANDSTILL, BalanceFilter
from .friction_remark import friction_remarks
from .history import History
from .monitor import DIFFERENCE, Monitor
from .slow_change import SlowChange
from .steps import StepEvents
from .variety import Variety

Array = NDArray[np.float64]

KEPT = 36_000  # bins whose torque is kept for judging teeth
TURNING = 3_000  # bins whose speed is kept for vibration
BEND = 0.1  # largest error of a slope as the mean acceleration of a bin, over the change within it
IDENTIFIABLE = 0.5  # share of the prior standard deviation below which a parameter is identifiable
NOISY = 1.25  # ratio of actual to expected standard deviation of innovations that causes a remark
REFUSED = 1.0  # [s] of successive gated balances that are a step
BALANCE = "both torques and a speed while the train turns"  # without which there is no balance
RARE = 3.0  # standard deviations of the first balance above which the readings do not fit the scene
UNITS = {"friction_level": "", "drag": "N m", "torque_zero": "N m", "torque_gain": "",
         "inertia": "kg m^2"}  # fmt: skip


@dataclass
class _Refusals:
    """Successive balances that the gate rejects."""

    begin: float = math.nan
    rare: bool = False

    first: bool = True

    def add(self, time: float, innovation: Innovation) -> float | None:
        """Return the time of the first of them, once they last `REFUSED`.

        The filter adapts to the first balance of all, so a rare one counts at once.
        """
        rare = self.first and abs(innovation.value) > RARE * innovation.sd
        self.first = False
        if not (innovation.gated or rare or self.rare):
            self.begin = math.nan
            return None
        self.rare |= rare
        if math.isnan(self.begin):
            self.begin = time
        if time - self.begin < REFUSED:
            return None
        begin, self.begin, self.rare = self.begin, math.nan, False
        return begin


@dataclass
class BalanceFollower:
    """Estimates friction level, drag, zero and gain of the torque sensors, and inertia.

    Two filters process the same readings: one whose parameters decay to their priors gives the
    intervals, and one whose parameters change slowly gives the innovations that show steps.
    """

    scene: Scene
    sensors: Sensors = field(default_factory=Sensors)
    period: float = PERIOD
    innovation: Innovation | None = field(init=False, default=None)
    """Innovation of the last bin, from the filter for intervals."""
    time: float = field(init=False, default=math.nan)
    """End of the last bin [s]."""
    gated: int = field(init=False, default=0)
    """Number of bins whose balance the gate has rejected."""

    def __post_init__(self) -> None:
        self.train = followed_train(self.scene)
        self._monitor = Monitor(self.scene, self.sensors, self.period)
        self._bins = CheckedBins(self.scene, self.train, self.sensors, self.period)
        self._refusals = _Refusals()
        self._slow_change = SlowChange()
        self._steps = StepEvents(self._monitor)
        self._last_speed: tuple[float, float] | None = None  # time and speed
        self._last_slope = 0.0  # [rad/s^2]
        self._variety = Variety(self.train)
        self._scatter = math.nan  # mean square deviation of a speed reading
        self._oil = self.train.oil_temperature
        self.operating = (math.nan, self.train.oil_temperature)
        """Speed of the input [rad/s], NaN before one is measured, and oil temperature [K]."""
        self._torques = History(KEPT, 2)  # end of bin, torque
        self._turning = History(TURNING, 3)  # middle of bin, speed, torque

    @property
    def events(self) -> list[Event]:
        """Detected changes."""
        return self._steps.events

    @property
    def counters(self) -> Counters:
        """Numbers of readings that were not used, by reason."""
        return self._bins.counters

    def add(self, time: Array, columns: Mapping[str, Array], sender: str = "readings") -> None:
        """Add readings of a sender, (n,) each, NaN where one is missing.

        Signs are those of gearbox_state. The order in which messages of several senders alternate
        has no effect as long as none lags behind by more than the times in `merging`. Raises
        `InputError` where a channel contradicts the scene.
        """
        for time_bin in self._bins.add(time, columns, sender):
            self._process(time_bin)

    def finish(self) -> None:
        """Process the bins that are still open, at the end of a recording."""
        for time_bin in self._bins.finish():
            self._process(time_bin)

    def _process(self, time_bin: Bin) -> None:
        self.time = (time_bin.number + 1) * self.period
        read = self._measured(time_bin)
        torque, speed = float(read.input_torque[0]), float(read.speed[0])
        if math.isfinite(torque):
            self._torques.add(self.time, torque)
        if math.isfinite(speed):
            self._turning.add(read.time, speed, torque)
            self.operating = speed, self._oil
        filter_before = self._interval_filter.kept()
        found = self._monitor.add(read)
        innovation = Innovation(*(values[0].item() for values in found.innovations))
        if math.isnan(innovation.value):
            return
        self._steps.note(read, filter_before)
        self.innovation = innovation
        self.gated += innovation.gated
        if not innovation.gated:
            self._variety.add(read)
        if self._slow_change.due(read.time) and self._identified(F):
            level, sd = self._interval_filter.apparent_level()
            self._slow_change.add(read.time, float(level[0]), float(sd[0]))
        refused_since = self._refusals.add(read.time, innovation)
        if len(found.steps.since):
            self._alarm(float(found.steps.since[0]), read.time)
        elif refused_since is not None:
            self._monitor.cusum.restart(np.array([True]), read.time)
            self._alarm(refused_since, read.time)
        self._steps.compare_causes(read)

    def _alarm(self, since: float, found: float) -> None:
        self._steps.alarm(since, found, self.operating)
        self._variety.restart()
        self._slow_change = SlowChange()

    @property
    def _interval_filter(self) -> BalanceFilter:
        return self._monitor.intervals

    def _measured(self, time_bin: Bin) -> Measured:
        means, nan = time_bin.means, math.nan
        time = (time_bin.number + 0.5) * self.period
        speed, acceleration, noise = nan, 0.0, 0.0
        mean, factor = time_bin.speed(self.train.ratio)
        if mean is not None:
            speed = mean.value * factor
            acceleration, noise = self._acceleration(time, speed, mean, factor)
        if "oil_temperature" in means:
            self._oil = means["oil_temperature"].value
        torques = means.get("input_torque"), means.get("output_torque")
        values = [nan if mean is None else mean.value for mean in torques]
        counts = [1 if mean is None else mean.readings for mean in torques]
        columns = np.array([*values, speed, acceleration, noise, self._oil])[:, np.newaxis]
        return Measured(time, columns[0], columns[1], np.array(counts)[:, np.newaxis], *columns[2:])

    def _acceleration(
        self, time: float, speed: float, mean: Mean, factor: float
    ) -> tuple[float, float]:
        """Acceleration of the input, and its standard deviation [rad/s^2]."""
        previous, self._last_speed = self._last_speed, (time, speed)
        if math.isfinite(mean.slope):
            if math.isfinite(mean.scatter):
                variance = (mean.scatter * factor) ** 2
                has_scatter = math.isfinite(self._scatter)
                self._scatter = (
                    self._scatter + 0.02 * (variance - self._scatter) if has_scatter else variance
                )
            time_norm = self.period * math.sqrt(mean.readings / 12.0)
            noise = math.sqrt(self._scatter) / time_norm if math.isfinite(self._scatter) else 0.0
            slope = mean.slope * factor
            change, self._last_slope = slope - self._last_slope, slope
            return slope, math.hypot(noise, BEND * change)
        if previous is None or time - previous[0] > 10.0 * self.period:
            return 0.0, 0.0
        slope = (speed - previous[1]) / (time - previous[0])
        return slope, DIFFERENCE * abs(slope)

    @property
    def scatter(self) -> float:
        """Standard deviation of innovations over that of the sensors' noise, at least 1."""
        return math.sqrt(float(self._interval_filter.excess[0]))

    def torque_between(self, begin: float, end: float) -> float:
        """Mean input torque [N m] of the bins that end within an interval; NaN if none does."""
        inside = self._torques.between(begin, end)[:, 1]
        return float(np.mean(inside)) if len(inside) else math.nan

    def turning_between(self, begin: float, end: float) -> Turning:
        """Speed and torque of the bins with middles within an interval [s] and just outside."""
        reach = 1.5 * self.period
        return Turning(*self._turning.between(begin - reach, end + reach).T)

    def estimates(self) -> tuple[Estimate, ...]:
        """Torque, loss and parameters: intervals, or the readings that would determine them."""
        if math.isnan(self.time):
            remedy = "readings of input_torque, output_torque and a speed"
            names = ["input_torque", "loss_torque", *UNITS]
            return tuple(
                not_identifiable(name, math.nan, UNITS.get(name, "N m"), remedy, "LEARNING")
                for name in names
            )
        return (*self._present_estimates(), *(self._parameter(n) for n in (F, D, B, G, J)))

    def _present_estimates(self) -> Iterator[Estimate]:
        interval_filter = self._interval_filter
        sd = float(interval_filter.torque_sd[0])
        if not sd < self.train.torque:
            yield not_identifiable("input_torque", sd, "N m", "readings of input_torque")
            yield not_identifiable("loss_torque", sd, "N m", "readings of both torques")
            return
        yield estimated("input_torque", float(interval_filter.torque[0]), sd, "N m")
        speed, oil = self.operating
        if self.innovation is None or abs(speed) <= STANDSTILL * self.train.speed:
            yield not_identifiable("loss_torque", math.nan, "N m", BALANCE)
            return
        value, value_sd = interval_filter.loss_torque(np.array([speed]), np.array([oil]))
        yield estimated("loss_torque", float(value[0]), float(value_sd[0]), "N m")

    def remarks(self) -> Iterator[str]:
        """Reasons why the estimates are less certain, one line each."""
        if self.scatter > NOISY:
            yield (
                f"the balance scatters {self.scatter:.1f} times as much as the noise of the torque "
                "sensors; intervals are widened accordingly"
            )
        cusum = self._monitor.cusum
        if cusum.held[0]:
            yield (
                f"successive innovations correlate by {cusum.correlation[0]:.2f}: further "
                "steps of the loss are not reported"
            )
        level = self._parameter(F)
        if level.status == "ESTIMATED" and math.isfinite(self.operating[0]):
            torque = self._interval_filter.torque[0]
            teeth = float(self._monitor.losses(torque, *self.operating).teeth)
            yield from friction_remarks(level.low, level.value, level.high, teeth)
        yield from self._slow_change.remarks()
        yield from self.counters.remarks()
        yield from self._bins.remarks()
        if self.gated:
            yield f"{self.gated} bins do not satisfy the torque balance and are not used"

    def _identified(self, state: int) -> bool:
        """Whether the readings determine a parameter much better than its prior."""
        prior = float(self._interval_filter.sd[state])
        return self._interval_filter.uncertainty(state) < IDENTIFIABLE * prior

    def _parameter(self, state: int) -> Estimate:
        interval_filter, name = self._interval_filter, PARAMETERS[state]
        sd = interval_filter.uncertainty(state)
        identified = self._identified(state)
        remedy = BALANCE
        if self.innovation is not None:
            remedy = self._variety.remedy(state, interval_filter.p[0], identified)
        if not identified:
            return not_identifiable(name, sd, UNITS[name], remedy)
        return estimated(name, float(interval_filter.x[0, state]), sd, UNITS[name], remedy)
