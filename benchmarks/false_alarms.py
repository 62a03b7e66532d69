"""False alarms of `follow` on healthy gearboxes: `python benchmarks/false_alarms.py`.

For each duty, four plants (the follower's own laws, another film, another friction, bearings on the
planets) play `--hours` / 4 each, at 100 readings a second, with errors of both torque sensors and
without any change. The plant is quasi-static: its losses come from its own table of runs. Every
event of the balance is a false alarm. The table has the largest of both sums of the CUSUM beside
its limit, and what the run length follows from: standard deviation and correlation of the terms of
one second. They are those of white noise if they are 1 and 0.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from following.plants import LAWS, paper, played
from numpy.typing import NDArray

from planetary_twin_py.following.balance.cusum import KAPPA, LIMIT, OVERSHOOT, TERM
from planetary_twin_py.following.balance.follower import BalanceFollower

Array = NDArray[np.float64]
DUTIES = "steady", "varied", "reversing", "four_quadrant"
FIRST_SEED = 5000
DAY = 86_400.0  # [s]


class Quiet(NamedTuple):
    """What a healthy play gave."""

    events: list[str]
    largest: float
    """Of both sums."""
    terms: np.ndarray
    """Standardised innovations of one second, (n,)."""


class Recorder:
    """Takes the place of a CUSUM: notes its terms and its largest sum."""

    def __init__(self, cusum: object) -> None:
        self._cusum, self.largest = cusum, 0.0
        self.terms: list[float] = []
        self._scores: list[float] = []
        self._begin: float | None = None

    def __getattr__(self, name: str) -> object:
        return getattr(self._cusum, name)

    def add(self, now: float, value: Array, sd: Array, loss: Array, step: float) -> object:
        """Pass an innovation on."""
        found = self._cusum.add(now, value, sd, loss, step)
        self.largest = max(self.largest, float(self._cusum.value.max()))
        if self._begin is None or now >= self._begin + TERM:
            if self._scores:
                self.terms.append(sum(self._scores) / math.sqrt(len(self._scores)))
            self._scores, self._begin = [], now
        if math.isfinite(value[0]):
            self._scores.append(float(value[0] / sd[0]))
        return found


def follow(duty: str, law: str, duration: float, seed: int) -> Quiet:
    """Follow a healthy plant."""
    _, stamps, columns = played(duty, LAWS[law], duration, seed)
    follower = BalanceFollower(paper())
    cusum = follower._monitor.cusum = Recorder(follower._monitor.cusum)
    follower.add(stamps, columns)
    follower.finish()
    events = [f"{one.what} at {one.found:.0f} s: {one.evidence}" for one in follower.events]
    return Quiet(events, cusum.largest, np.array(cusum.terms))


def run_length(sd: float) -> float:
    """Mean time between false alarms of either sign [s], of independent normal terms.

    Siegmund (1985), Sequential Analysis, eq. 2.59, with the drift and the limit over `sd`.
    """
    drift, limit = KAPPA / sd, LIMIT / sd + OVERSHOOT
    one = (math.exp(2.0 * drift * limit) - 2.0 * drift * limit - 1.0) / (2.0 * drift**2)
    return 0.5 * TERM * one


def main() -> None:
    """Print alarms by duty and law."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--hours", type=float, default=24.0, help="of each duty")
    parser.add_argument("--duty", choices=DUTIES, help="only this one")
    given = parser.parse_args()
    part = given.hours * 3600.0 / len(LAWS)
    print(
        f"{'duty':<10} {'law':<17} {'hours':>6} {'alarms':>7} {'largest sum':>12} {'limit':>6} "
        f"{'sd':>6} {'correlation':>12} {'days to one, if white':>22} {'processor s':>12}"
    )
    for duty in DUTIES if given.duty is None else (given.duty,):
        for n, law in enumerate(LAWS):
            begin = time.process_time()
            found = follow(duty, law, part, FIRST_SEED + n)
            terms = found.terms - found.terms.mean()
            sd = float(np.std(terms))
            correlation = float(np.mean(terms[1:] * terms[:-1]) / sd**2)
            print(
                f"{duty:<10} {law:<17} {part / 3600.0:>6.3g} {len(found.events):>7} "
                f"{found.largest:>12.1f} {LIMIT:>6.1f} {sd:>6.3f} {correlation:>12.3f} "
                f"{run_length(sd) / DAY:>22.3g} {time.process_time() - begin:>12.0f}",
                flush=True,
            )
            for event in found.events:
                print(f"    {event}", flush=True)


main()
