"""False alarms of vibration on healthy gearboxes: `python benchmarks/false_alarms_vibration.py`.

For each duty, plants of five laws play `--hours` / 5 each without any change: an accelerometer
behind an unknown path, and torque and speed of the input every 0.1 s with the noise of a mean of
ten readings. Every event is a false alarm. The last columns have those at 0.7 of the limit, which
are no events, and the shares of hunting periods that are compared with a baseline.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from following.plants import TEETH_LAWS

import planetary_twin_py as pt
from planetary_twin_py.following.estimate import Event
from planetary_twin_py.following.sensors import Sensors
from planetary_twin_py.following.turning import Turning
from planetary_twin_py.following.vibration.follower import VibrationFollower
from planetary_twin_py.following.vibration.growth import (
    JudgedPeriod,
    LearnedBaseline,
    VibrationGrowth,
)
from planetary_twin_py.following.vibration.patterns import patterns_of
from planetary_twin_py.plant.hidden import Hidden
from planetary_twin_py.plant.readings import Plant
from planetary_twin_py.plant.sampled import simulate_samples

DUTIES = {
    "steady": {"torque_wander": 0.03, "speed_wander": 0.003},
    "varied": {"kind": "varied"},
    "reversing": {"kind": "reversing"},
}
RATE, STEP = 4_000.0, 0.1  # [Hz], [s]
NOISE = 0.1 / np.sqrt(10.0), 0.02 / np.sqrt(10.0)  # [N m], [rad/s]
NEAR = 0.7  # of the limit


class _Nearly(VibrationGrowth):
    """Judges the same hunting periods as another one, with a lower limit."""

    def _limit(self, duration: float) -> float:
        return NEAR * super()._limit(duration)

    def beside(self, growth: VibrationGrowth) -> None:
        """Judge what `growth` judges from now on."""
        usual = growth.add

        def add(period: JudgedPeriod, cell: LearnedBaseline, end: float) -> bool:
            own = self.baseline_at(period.torque, period.speed)
            self.add(period, own or LearnedBaseline(cell.torque, cell.speed, cell.highest), end)
            return usual(period, cell, end)

        growth.add = add  # type: ignore[method-assign]


def follow(duty: str, law: str, duration: float, seed: int) -> tuple[VibrationFollower, _Nearly]:
    """Follow a healthy plant with the limit, and with a share of it."""
    hidden = Hidden.model_validate(
        {"scene": TEETH_LAWS[law], "duty": DUTIES[duty], "seed": seed,
         "sensors": {"vibration": {"rate": RATE, "lost": 1e-3}}}
    )  # fmt: skip
    plant, chance = Plant(pt.load_scene("paper"), hidden, duration), np.random.default_rng(seed)
    stamps = np.arange(0.5 * STEP, duration, STEP)
    torque, speed = (
        course(stamps) + noise * chance.standard_normal(len(stamps))
        for course, noise in zip(
            (plant.course.torque_at, plant.course.speed_at), NOISE, strict=True
        )
    )

    def turning(begin: float, end: float) -> Turning:
        first, last = np.searchsorted(stamps, (begin - 1.5 * STEP, end + 1.5 * STEP))
        return Turning(stamps[first:last], speed[first:last], torque[first:last])

    names = ("housing",)
    follower = VibrationFollower(plant.train, names, 1.0 / RATE, Sensors())
    nearly = _Nearly(names, patterns_of(plant.train, None), Sensors().learning)
    nearly.beside(follower._growth)
    for samples in simulate_samples(plant, "vibration"):
        at = samples.sample / RATE
        follower.add(at, samples.values)
        follower.judge(float(at[-1]) - 2.0 * STEP, turning)
    return follower, nearly


def _text(event: Event) -> str:
    return f"{event.what} at {event.found:.0f} s: {event.evidence.partition(';')[0]}"


def main() -> None:
    """Print alarms by duty and law."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--hours", type=float, default=24.0, help="of each duty")
    parser.add_argument("--duty", choices=[*DUTIES], help="only this one")
    parser.add_argument("--seed", type=int, default=8000, help="of the first law of each duty")
    given = parser.parse_args()
    part = given.hours * 3600.0 / len(TEETH_LAWS)
    print(f"{'duty':<10} {'law':<17} {'hours':>6} {'alarms':>7} {'near':>5} {'compared':>9} "
          f"{'dropped':>8} {'processor s':>12}")  # fmt: skip
    for duty in DUTIES if given.duty is None else (given.duty,):
        for n, law in enumerate(TEETH_LAWS):
            begin = time.process_time()
            follower, nearly = follow(duty, law, part, given.seed + n)
            counted = follower.counters
            every = counted.periods + counted.dropped_periods
            print(
                f"{duty:<10} {law:<17} {part / 3600.0:>6.3g} {len(follower.events):>7} "
                f"{len(nearly.events) - len(follower.events):>5} "
                f"{counted.compared_periods / every:>9.0%} {counted.dropped_periods / every:>8.0%} "
                f"{time.process_time() - begin:>12.0f}",
                flush=True,
            )
            for event in follower.events or nearly.events:
                print(f"    {_text(event)}", flush=True)


main()
