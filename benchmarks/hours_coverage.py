"""Coverage of 95 % intervals of `follow` over hours: `python benchmarks/hours_coverage.py`.

For three duties and three plants (the follower's own law, another friction, bearings on the planets
with zeros of both torque sensors that drift), `--runs` gearboxes with errors of both torque
sensors and a drag that the scene lacks run together. At each full hour, the share of the estimates
whose interval holds the truth is printed. No step happens: every event is a false alarm.

The readings are those of the middle of each `PERIOD`, with the noise of a mean; the losses are
those of the table of the plant, as in `simulate_readings`.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from following.plants import LAWS, paper

from planetary_twin_py.following.balance import IDENTIFIABLE
from planetary_twin_py.following.balance_filter import DRAG, PARAMETERS, B, D, F, G, J, Measured
from planetary_twin_py.following.loss_map import loss_map
from planetary_twin_py.following.monitor import Monitor
from planetary_twin_py.following.sensors import Sensors, torque_noise
from planetary_twin_py.plant.course import draw_course
from planetary_twin_py.plant.hidden import Duty

Array = NDArray[np.float64]

DUTIES = "steady", "varied", "reversing"
PLANTS = {
    "own law": LAWS["the same"],
    "other law": LAWS["another friction"],
    "bearings": {"losses.planet_bearing": {"mean_diameter": 0.02}},
}
DRIFTING = "bearings"
PERIOD, READINGS = 0.5, 50  # [s] of a mean, and readings in it
DRIFT = 86_400.0  # [s] period of zeros that drift as the temperature of a day does
SPEED_NOISE = 0.02  # [rad/s] of a reading
TOGETHER = 2000  # rows that are simulated together
HOUR = 3600.0


class Plants:
    """Gearboxes of one duty and law.

    Args:
        duty: kind of the duty.
        plant: kind of the plant, of `PLANTS`.
        count: number of gearboxes.
        duration: duration [s].
        seed: seed of all random numbers.
    """

    def __init__(self, duty: str, plant: str, count: int, duration: float, seed: int) -> None:
        self.chance = np.random.default_rng([seed, 41])
        scene, self.count = paper(), count
        self.monitor = Monitor(scene, Sensors(), PERIOD, count)
        self.train, self.losses = (
            self.monitor.train,
            loss_map(scene.replace(**PLANTS[plant])),
        )
        kind = Duty(kind=duty)
        self.courses = [
            draw_course(kind, (), self.train, duration, np.random.default_rng([seed, n, 43]))
            for n in range(count)
        ]
        self.noise = np.array(torque_noise(Sensors(), self.train)) / np.sqrt(READINGS)
        normal = self.chance.standard_normal
        self.zero_sd = 0.5 * np.array(torque_noise(Sensors(), self.train))[:, None]
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
        self.rows = int(duration / PERIOD)

    def readings(self) -> Iterator[Measured]:
        """Means of all gearboxes, in the order of time."""
        for begin in range(0, self.rows, TOGETHER):
            time = (np.arange(begin, min(begin + TOGETHER, self.rows)) + 0.5) * PERIOD
            torque, speed, acceleration = (
                np.array([getattr(course, name)(time) for course in self.courses]).T
                for name in ("torque_at", "speed_at", "acceleration_at")
            )
            oil = np.full(self.count, self.train.oil_temperature)
            losses = self.losses(torque, speed, oil)
            lost = np.sign(speed) * (losses.total + self.drag)
            noise = self.chance.standard_normal((4, *torque.shape))
            slope_noise = SPEED_NOISE / PERIOD * np.sqrt(12.0 / READINGS)
            for n, now in enumerate(time):
                self.zero = self.zeros * np.sin(self.phases + self.rate * now)
                driving = torque[n] + self.train.inertia * acceleration[n]
                driven = (lost[n] - torque[n]) / self.train.ratio
                ends = np.array([driving, driven]) * (1.0 + self.gain) + self.zero
                ends += self.noise[:, None] * noise[:2, n]
                yield Measured(
                    float(now), *ends, np.full((2, 1), READINGS),
                    speed[n] + SPEED_NOISE / np.sqrt(READINGS) * noise[2, n],
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


def follow(plants: Plants) -> None:
    """Follow gearboxes and print a line for each hour and parameter that is identified."""
    alarms, filters = 0, plants.monitor.intervals
    every = round(HOUR / PERIOD)
    for n, read in enumerate(plants.readings(), 1):
        alarms += len(plants.monitor.add(read).steps.since)
        if n % every:
            continue
        for state, true in plants.truths().items():
            sd = np.sqrt(filters.p[:, state, state])
            known = sd < IDENTIFIABLE * filters.sd[state]
            if known.any():
                error = (filters.x[:, state] - true)[known]
                inside = np.mean(np.abs(error) <= 1.96 * sd[known])
                print(
                    f"{n / every:>6.0f} {PARAMETERS[state]:<15} {known.sum():>6} {inside:>7.0%} "
                    f"{np.mean(sd[known]):>9.3g} {np.sqrt(np.mean(error**2)):>9.3g} {alarms:>7}",
                    flush=True,
                )


def main() -> None:
    """Print coverage by duty, plant, hour and parameter."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=20, help="of each duty and plant")
    parser.add_argument("--hours", type=float, default=6.0)
    parser.add_argument("--duty", choices=DUTIES, help="only this one")
    parser.add_argument("--plant", choices=[*PLANTS], help="only this one")
    given = parser.parse_args()
    print(f"  hour {'quantity':<15} {'known':>6} {'inside':>7} {'sd':>9} {'rms':>9} {'alarms':>7}")
    for duty in DUTIES if given.duty is None else (given.duty,):
        for plant in PLANTS if given.plant is None else (given.plant,):
            begin = time.process_time()
            plants = Plants(duty, plant, given.runs, given.hours * HOUR, 1)
            print(f"{duty}, {plant}: friction level {plants.level:.3f}")
            follow(plants)
            print(f"    {time.process_time() - begin:.0f} s of processor time", flush=True)


main()
