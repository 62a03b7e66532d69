"""How often 95 % intervals of `follow` hold the truth: `python benchmarks/interval_coverage.py`.

Each run takes a law of the plant (the follower's own, another film, another friction, bearings on
the planets), draws errors of both torque sensors, a drag that the scene lacks and a load, plays
60 s, and compares every estimate with the truth. The column z rms is the root mean square of the
errors over the stated standard deviations: 1 where intervals are as wide as they should be, less
where they are too wide.
"""

from __future__ import annotations

import argparse
import sys
from collections import defaultdict
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from following.plants import LAWS, balance_of, friction_level, paper

DUTIES = "steady", "varied", "reversing"
DURATION = 60.0  # [s]
DRAG = 5e-4  # standard deviation of a drag that the scene lacks, over the torque of the scene
FIRST_SEED = 1000


def truths(plant: object, follower: object) -> dict[str, float]:
    """True values of the estimates at the end of a play, in SI."""
    sensors, ratio = plant.hidden.sensors, follower.train.ratio
    return {
        "friction_level": friction_level(plant),
        "torque_zero": sensors.input_torque.zero + ratio * sensors.output_torque.zero,
        "drag": plant.hidden.changes[0].drag,
        "torque_gain": sensors.input_torque.gain - sensors.output_torque.gain,
        "inertia": follower.train.inertia,
    }


def main() -> None:
    """Print coverage by duty and quantity."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=50, help="runs of each duty")
    parser.add_argument("--duty", choices=DUTIES, help="only this one")
    given = parser.parse_args()
    runs = given.runs
    print(f"{'duty':<10} {'quantity':<15} {'estimated':>9} {'inside':>7} {'z rms':>6} {'sd':>9}")
    for duty in DUTIES if given.duty is None else (given.duty,):
        scores: dict[str, list[tuple[float, float]]] = defaultdict(list)
        for run in range(runs):
            law = LAWS[[*LAWS][run % len(LAWS)]]
            chance = np.random.default_rng([FIRST_SEED + run, 23])
            drag = DRAG * paper().operating_point.input_torque * abs(chance.standard_normal())
            hidden = ({"at": 0.0, "drag": float(drag)},)
            plant, follower = balance_of(duty, law, DURATION, FIRST_SEED + run, hidden)
            follower.finish()
            true = truths(plant, follower)
            for one in follower.estimates():
                if one.status == "ESTIMATED" and one.name in true:
                    half = 0.5 * (one.high - one.low)
                    scores[one.name].append(((one.value - true[one.name]) / half, one.sd))
        for name, found in scores.items():
            part, sd = np.array(found).T
            print(
                f"{duty:<10} {name:<15} {len(part):>9} {np.mean(np.abs(part) <= 1.0):>7.0%} "
                f"{1.96 * np.sqrt(np.mean(part**2)):>6.2f} {np.mean(sd):>9.3g}",
                flush=True,
            )


main()
