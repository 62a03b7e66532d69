"""Detection of cracks, and coverage of their sizes: `python benchmarks/tooth_coverage.py`.

Each run takes a law of the plant and draws gear, tooth, loss of stiffness (0.5 to 3 %) and instant,
or takes the gear of `--gear` and the loss of `--loss`.
The load wanders by 2 %. After every hunting period the stated size, its interval and the earliest
start are compared with the truth. The last columns have the share of intervals that hold, by the
number of hunting periods since the crack was found.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from following.plants import TEETH_LAWS, crack, hunted

GEARS = {"sun": 30, "planet": 20, "ring": 70}
LEARNED, AFTER = 22.0, 30.0  # [s]
LOSSES = 0.005, 0.03
AGES = 1, 2, 4, 8, 16, 32  # upper ends of classes of hunting periods
FIRST_SEED = 9000


class Stated(NamedTuple):
    """What is stated after a hunting period."""

    age: int
    """Hunting periods since the crack was found."""
    z: float
    """Error of the size over its standard deviation; NaN while there is no size."""


class Outcome(NamedTuple):
    """One run."""

    gear: str
    delay: float
    """From the crack to its detection [s]; NaN if it is not found."""
    right: bool
    """The tooth is among those named."""
    others: int
    """Events of other teeth."""
    early: bool
    """The stated start is not after the crack."""
    stated: list[Stated]


def outcome(law: str, seed: int, gears: list[str], losses: tuple[float, float]) -> Outcome:
    """Play and follow one cracked tooth."""
    chance = np.random.default_rng(seed)
    kind = str(chance.choice(gears))
    number = int(chance.integers(GEARS[kind]))
    more = {"planet": int(chance.integers(1, 4))} if kind == "planet" else {}
    gear = f"planet_{more['planet']}" if more else kind
    low, high = np.log(losses)
    loss = float(np.exp(chance.uniform(low, high)))
    at = LEARNED + float(chance.uniform(0.0, 3.0))
    change = {"at": at, "faults": [crack(kind, number, loss, **more)]}
    name, found, stated = f"{gear} tooth {number}", math.nan, []
    right, early, age = False, False, 0
    for _, follower in hunted(TEETH_LAWS[law], (change,), at + AFTER, seed):
        tooth = next((one for one in follower.teeth if name in one.candidates), None)
        if tooth is None:
            continue
        age += 1
        if not right:
            what = f"{tooth.gear} tooth {tooth.tooth} changed"
            event = next(one for one in follower.events if one.what == what)
            right, found, early = True, event.found, event.since <= at
        stated.append(Stated(age, (tooth.loss.value - loss) / tooth.loss.sd))
    others = len(follower.events) - right
    return Outcome(kind, found - at, right, others, early, stated)


def main() -> None:
    """Print detection and coverage by law and gear."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=50)
    parser.add_argument("--gear", choices=[*GEARS], help="only this one")
    parser.add_argument("--loss", type=float, help="only this one")
    given = parser.parse_args()
    gears = [*GEARS] if given.gear is None else [given.gear]
    losses = LOSSES if given.loss is None else (given.loss, given.loss)
    found: dict[str, list[Outcome]] = {}
    begin = time.process_time()
    for run in range(given.runs):
        law = [*TEETH_LAWS][run % len(TEETH_LAWS)]
        found.setdefault(law, []).append(outcome(law, FIRST_SEED + run, gears, losses))
    every = [one for group in found.values() for one in group]
    by_gear = {gear: [one for one in every if one.gear == gear] for gear in GEARS}
    ages = " ".join(f"{f'<= {age}':>7}" for age in AGES)
    print(f"{'':<18} {'runs':>5} {'found':>6} {'median s':>9} {'slowest':>8} {'others':>7} "
          f"{'start held':>11} {'sizes held, ages':>17} {ages}")  # fmt: skip
    for name, group in (found | by_gear | {"all": every}).items():
        print(f"{name:<18} {_line(group)}", flush=True)
    print(f"{time.process_time() - begin:.0f} s of processor time")


def _line(group: list[Outcome]) -> str:
    right = [one for one in group if one.right]
    delays = [one.delay for one in right] or [math.nan]
    early = np.mean([one.early for one in right]) if right else math.nan
    return (
        f"{len(group):>5} {len(right):>6} {np.median(delays):>9.2f} {max(delays):>8.2f} "
        f"{sum(one.others for one in group):>7} {early:>11.0%} {'':>17} " + " ".join(_shares(right))
    )


def _shares(group: list[Outcome]) -> Iterator[str]:
    low = 0
    for high in AGES:
        held = [abs(s.z) <= 1.96 for one in group for s in one.stated
                if low < s.age <= high and math.isfinite(s.z)]  # fmt: skip
        yield f"{np.mean(held):>7.0%}" if held else f"{'-':>7}"
        low = high


main()
