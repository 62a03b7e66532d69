"""Many gearboxes of one duty and law, whose readings are those of bins of a follower."""

from collections.abc import Iterator

import numpy as np
from following.plants import LAWS, paper
from numpy.typing import NDArray

from planetary_twin_py.following.balance.balances import B, D, F, G, J, Measured
from planetary_twin_py.following.balance.follower import IDENTIFIABLE
from planetary_twin_py.following.balance.monitor import Monitor
from planetary_twin_py.following.loss_map import loss_map
from planetary_twin_py.following.sensors import Sensors, torque_errors
from planetary_twin_py.plant.course import draw_course
from planetary_twin_py.plant.hidden import Duty

Array = NDArray[np.float64]
PLANTS = {
    "own law": LAWS["the same"],
    "other law": LAWS["another friction"],
    "bearings": {"losses.planet_bearing": {"mean_diameter": 0.02}},
}
DRIFTING = "bearings"
RATE = 100.0  # [Hz] of the readings that a mean has
DRIFT = 86_400.0  # [s] period of zeros that drift as the temperature of a day does
SPEED_NOISE = 0.02  # [rad/s] of a reading
DRAG = 5e-4  # standard deviation of a drag over the torque of the scene
TOGETHER = 2000  # rows that are simulated together


class Plants:
    """Gearboxes of one duty and law.

    Readings are those of the middle of each period, with the noise of a mean.

    Args:
        duty: kind of the duty.
        plant: kind of the plant, of `PLANTS`.
        count: number of gearboxes.
        duration: duration [s].
        period: time between two means [s].
    """

    def __init__(self, duty: str, plant: str, count: int, duration: float, period: float) -> None:
        self.chance = np.random.default_rng(41)
        scene, self.count, self.period = paper(), count, period
        self.each = period * RATE
        self.monitor = Monitor(scene, Sensors(), self.period, count)
        self.train, self.losses = (
            self.monitor.train,
            loss_map(scene.replace(**PLANTS[plant])),
        )
        kind = Duty(kind=duty)
        self.courses = [
            draw_course(kind, (), self.train, duration, np.random.default_rng([n, 43]))
            for n in range(count)
        ]
        errors = torque_errors(Sensors(), self.train)
        self.noise = np.array([one.noise for one in errors]) / np.sqrt(self.each)
        normal = self.chance.standard_normal
        self.zero_sd = np.array([one.zero for one in errors])[:, None]
        self.zeros = np.sqrt(2.0) * self.zero_sd
        self.phases = 2.0 * np.pi * self.chance.random((2, count))
        self.rate = 2.0 * np.pi / DRIFT if plant == DRIFTING else 0.0
        self.zero = self.zeros * np.sin(self.phases)
        self.gain = 1e-3 * normal((2, count))
        self.drag = DRAG * self.train.torque * np.abs(normal(count))
        point = scene.operating_point
        at = point.input_torque, point.input_speed, point.oil_temperature
        true, nominal = self.losses(*at), self.monitor.losses(*at)
        self.level = float((true.total - nominal.rest) / nominal.teeth)
        self.rows = int(duration / self.period)

    def readings(self) -> Iterator[Measured]:
        """Means of all gearboxes, in the order of time."""
        for begin in range(0, self.rows, TOGETHER):
            time = (np.arange(begin, min(begin + TOGETHER, self.rows)) + 0.5) * self.period
            torque, speed, acceleration = (
                np.array([getattr(course, name)(time) for course in self.courses]).T
                for name in ("torque_at", "speed_at", "acceleration_at")
            )
            oil = np.full(self.count, self.train.oil_temperature)
            losses = self.losses(torque, speed, oil)
            lost = np.sign(speed) * (losses.total + self.drag)
            noise = self.chance.standard_normal((4, *torque.shape))
            slope_noise = SPEED_NOISE / self.period * np.sqrt(12.0 / self.each)
            for n, now in enumerate(time):
                self.zero = self.zeros * np.sin(self.phases + self.rate * now)
                driving = torque[n] + self.train.inertia * acceleration[n]
                driven = (lost[n] - torque[n]) / self.train.ratio
                ends = np.array([driving, driven]) * (1.0 + self.gain) + self.zero
                ends += self.noise[:, None] * noise[:2, n]
                yield Measured(
                    float(now), *ends, np.full((2, 1), self.each),
                    speed[n] + SPEED_NOISE / np.sqrt(self.each) * noise[2, n],
                    acceleration[n] + slope_noise * noise[3, n],
                    np.full(self.count, slope_noise), oil,
                )  # fmt: skip

    def truths(self) -> dict[int, Array]:
        """True parameters now, (n,) each, by their index."""
        return {
            F: np.full(self.count, self.level),
            B: self.zero[0] + self.train.ratio * self.zero[1],
            D: self.drag,
            G: self.gain[0] - self.gain[1],
            J: np.full(self.count, self.train.inertia),
        }

    def errors(self) -> Iterator[tuple[int, Array, Array]]:
        """Index of each parameter that is identified, its errors and standard deviations."""
        filters = self.monitor.intervals
        for state, true in self.truths().items():
            sd = np.sqrt(filters.p[:, state, state])
            known = sd < IDENTIFIABLE * filters.sd[state]
            if known.any():
                yield state, (filters.x[:, state] - true)[known], sd[known]
