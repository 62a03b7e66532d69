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
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from following.gearboxes import PLANTS, Plants

from planetary_twin_py.following.balance.balances import PARAMETERS

DUTIES = "steady", "varied", "reversing"
PERIOD = 0.5  # [s] of a mean
HOUR = 3600.0


def follow(plants: Plants) -> None:
    """Follow gearboxes and print a line for each hour and parameter that is identified."""
    alarms, every = 0, round(HOUR / PERIOD)
    for n, read in enumerate(plants.readings(), 1):
        alarms += len(plants.monitor.add(read).steps.since)
        if n % every:
            continue
        for state, error, sd in plants.errors():
            inside = np.mean(np.abs(error) <= 1.96 * sd)
            print(
                f"{n / every:>6.0f} {PARAMETERS[state]:<15} {len(error):>6} {inside:>7.0%} "
                f"{np.mean(sd):>9.3g} {np.sqrt(np.mean(error**2)):>9.3g} {alarms:>7}",
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
            plants = Plants(duty, plant, given.runs, given.hours * HOUR, PERIOD)
            print(f"{duty}, {plant}: friction level {plants.level:.3f}")
            follow(plants)
            print(f"    {time.process_time() - begin:.0f} s of processor time", flush=True)


main()
