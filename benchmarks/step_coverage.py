"""Sizes, starts and causes of steps of friction: `python benchmarks/step_coverage.py`.

Each run takes a law of the plant (the follower's own, another film, another friction, bearings on
the planets), draws errors of both torque sensors and a step of friction of 5 to 20 % of either
sign, and compares the first event after it with the truth: the mean of the added loss from the step
to its detection. A cause is wrong if friction is not among those named a minute later.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from following.plants import LAWS, balance_of

from planetary_twin_py.following.loss_map import loss_map

DUTIES = "steady", "varied", "reversing"
BEFORE, AFTER = 20.0, 60.0  # [s]
STEPS = 0.05, 0.2
FIRST_SEED = 4000


class Outcome(NamedTuple):
    """A step that was found."""

    delay: float
    """[s]."""
    share: float
    """Stated size over the true one."""
    z: float
    """Error of the size in standard deviations."""
    early: bool
    """The stated start is not after the step."""
    wrong: bool
    """Friction is not among the causes."""
    others: int
    """Further events."""


def outcome(duty: str, law: str, seed: int) -> Outcome | None:
    """Play and follow one step; None if it is not found."""
    chance = np.random.default_rng([seed, 29])
    at = BEFORE + float(chance.uniform(0.0, 5.0))
    step = float(np.exp(chance.uniform(*np.log(STEPS)))) * float(chance.choice([-1.0, 1.0]))
    change = {"at": at, "friction": 1.0 + step}
    plant, follower = balance_of(duty, LAWS[law], at + AFTER, seed, (change,))
    follower.finish()
    event = next((one for one in follower.events if one.found >= at), None)
    if event is None:
        return None
    when = np.arange(at, event.found, 0.1)
    losses, oil = loss_map(plant.true_scene), plant.true_scene.operating_point.oil_temperature
    points = plant.course.torque_at(when), plant.course.speed_at(when)
    true = step * float(np.mean(losses(*points, oil).teeth))
    size = event.size
    return Outcome(
        event.found - at, size.value / true, (size.value - true) / size.sd, event.since <= at,
        "friction" not in event.causes, len(follower.events) - 1,
    )  # fmt: skip


def main() -> None:
    """Print a line for each duty."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=50, help="of each duty")
    given = parser.parse_args()
    print(
        f"{'duty':<10} {'runs':>5} {'found':>6} {'median s':>9} {'size/true':>10} {'inside':>7} "
        f"{'z rms':>6} {'start held':>11} {'wrong causes':>13} {'others':>7} {'processor s':>12}"
    )
    for duty in DUTIES:
        begin = time.process_time()
        every = [outcome(duty, [*LAWS][n % len(LAWS)], FIRST_SEED + n) for n in range(given.runs)]
        found = [one for one in every if one is not None]
        delay, share, z, early, wrong, others = np.array(found, dtype=float).T
        print(
            f"{duty:<10} {len(every):>5} {len(found):>6} {np.median(delay):>9.1f} "
            f"{np.mean(share):>10.2f} {np.mean(np.abs(z) <= 1.96):>7.0%} "
            f"{np.sqrt(np.mean(z**2)):>6.2f} {np.mean(early):>11.0%} {int(wrong.sum()):>13} "
            f"{int(others.sum()):>7} {time.process_time() - begin:>12.0f}",
            flush=True,
        )


main()
