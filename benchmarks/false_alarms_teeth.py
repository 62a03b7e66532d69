"""False alarms of teeth on a healthy gearbox: `python benchmarks/false_alarms_teeth.py`.

First, encoders of plants with other laws are played sample by sample for `--minutes` each, at the
load of the scene, which wanders by 2 %. The table has the largest z of any tooth in any window
beside the limit, and for the z of single hunting periods: their standard deviation, their kurtosis
less 3, and their correlation from one to the next. White noise has 1 and the uncertainty of the
baseline, 0 and 1/25 (the baseline is common to all, so they correlate by its share).

Second, `--days` are played at the level of the scores. Noise that is white from sample to sample
and from one hunting period to the next gives normal scores whose covariance is that of the
signatures. Baselines are learned from 24 hunting periods as the follower does it, and a new one
begins each day.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from following.plants import COUNTS, RATE, TEETH_LAWS

import planetary_twin_py as pt
from planetary_twin_py.following.teeth.follower import WINDOWS, TeethFollower
from planetary_twin_py.following.teeth.hunting_blocks import BINS
from planetary_twin_py.following.teeth.scores import Bank
from planetary_twin_py.following.teeth.search import ALARM
from planetary_twin_py.following.teeth.signatures import signatures
from planetary_twin_py.following.train import followed_train
from planetary_twin_py.plant.hidden import Hidden
from planetary_twin_py.plant.readings import Plant
from planetary_twin_py.plant.sampled import simulate_samples

SEED = 7000
LEARNING = 24  # hunting periods of a baseline
DAY = 86_400.0  # [s]


class Quiet(NamedTuple):
    """What a healthy play gave."""

    z: np.ndarray
    """Of every tooth in each judged hunting period, (n, teeth)."""
    largest: float
    """Of any tooth in any window."""
    alarms: int


def follow(laws: dict[str, object], seconds: float, seed: int) -> Quiet:
    """Follow a healthy plant."""
    encoders = {"rate": RATE, "lost": 0.003}
    hidden = Hidden.model_validate(
        {"scene": laws, "duty": {"torque_wander": 0.02}, "sensors": {"encoders": encoders},
         "seed": seed}
    )  # fmt: skip
    plant = Plant(pt.load_scene("paper"), hidden, seconds)
    follower = TeethFollower(plant.scene, (COUNTS, COUNTS), 1.0 / RATE, LEARNING)
    noise = np.random.default_rng([seed, 5])

    def torque(begin: float, end: float) -> float:
        """Mean of 84 readings with 0.1 N m of noise."""
        true = plant.course.torque_at(np.linspace(begin, end, 50)).mean()
        return float(true) + 0.011 * noise.standard_normal()

    found, largest = [], -np.inf
    for packets in simulate_samples(plant, "encoders"):
        before = follower.blocks
        follower.add(packets.sample, packets.values)
        follower.judge(np.inf, torque)
        if follower.blocks != before and follower.every_z:
            found.append(follower.every_z)
            largest = max(largest, follower.outstanding)
    return Quiet(np.array(found), largest, len(follower.events))


def windows(scores: np.ndarray, sd: np.ndarray) -> float:
    """Largest z of any tooth in any window; scores have the baseline taken off, (n, teeth)."""
    sums = np.concatenate([np.zeros((1, scores.shape[1])), np.cumsum(scores, axis=0)])
    largest = -np.inf
    for count in WINDOWS:
        means = (sums[count:] - sums[:-count]) / count
        noise = sd * np.sqrt(1.0 / count + 1.0 / LEARNING)
        largest = max(largest, float(np.max(means / noise)))
    return largest


def of_scores(days: int, period: float) -> np.ndarray:
    """Largest z of each day, (days,)."""
    scene = pt.load_scene("paper")
    train = followed_train(scene)
    bank = Bank(signatures(scene, train.torque, train.speed))
    cycles = train.hunting_cycles
    every = np.stack([bank.deviation(n, cycles).ravel() for n in range(len(bank.teeth))])
    assert every.shape == (len(bank.teeth), cycles * BINS)
    gram = every @ every.T
    # Of e = s'r / s's with white r of unit variance.
    square = np.diag(gram)
    values, vectors = np.linalg.eigh(gram / np.outer(square, square))
    root = vectors * np.sqrt(np.maximum(values, 0.0))
    chance, found = np.random.default_rng(SEED), []
    for _ in range(days):
        count = LEARNING + int(DAY / period)
        scores = chance.standard_normal((count, len(root))) @ root.T
        mean = scores[:LEARNING].mean(axis=0)
        squares = np.mean((scores[:LEARNING] - mean) ** 2, axis=0) / (1.0 - 1.0 / LEARNING)
        gears = [np.sqrt(np.mean(squares[bank.gear_of == g])) for g in range(len(bank.gears))]
        found.append(windows(scores[LEARNING:] - mean, np.array(gears)[bank.gear_of]))
    return np.array(found)


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=10.0, help="of each plant")
    parser.add_argument("--days", type=int, default=100, help="of scores")
    given = parser.parse_args()
    scene = pt.load_scene("paper")
    train = followed_train(scene)
    turns = train.hunting_cycles / abs(float(train.cycles))
    period = turns * 2.0 * np.pi / train.speed
    print(
        f"{'plant':<18} {'periods':>8} {'alarms':>7} {'largest z':>10} {'sd':>6} "
        f"{'kurtosis - 3':>13} {'correlation':>12} {'processor s':>12}"
    )
    for n, (name, laws) in enumerate(TEETH_LAWS.items()):
        begin = time.process_time()
        z, largest, alarms = follow(laws, 60.0 * given.minutes, SEED + n)
        centred = z - z.mean()
        sd = float(np.std(z))
        kurtosis = float(np.mean(centred**4) / sd**4 - 3.0)
        correlation = float(np.mean(centred[1:] * centred[:-1]) / sd**2)
        print(
            f"{name:<18} {len(z):>8} {alarms:>7} {largest:>10.2f} {sd:>6.3f} {kurtosis:>13.3f} "
            f"{correlation:>12.3f} {time.process_time() - begin:>12.0f}",
            flush=True,
        )
    if given.days:
        days = of_scores(given.days, period)
        print(
            f"scores, {given.days} days: largest z of a day {np.median(days):.2f} (median), "
            f"{days.max():.2f} (worst); {int(np.sum(days > ALARM))} days with an alarm; "
            f"limit {ALARM}"
        )


main()
