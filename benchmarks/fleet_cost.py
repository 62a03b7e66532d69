"""Processor time of following a fleet: `python benchmarks/fleet_cost.py`.

A thousand gearboxes of one type, a row each second.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from fleet.fleets import Played, paper

from planetary_twin_py.fleet.fleet import Fleet

DAY = 86_400.0  # [s]


def main() -> None:
    """Print the share of a core, and the processor time of one gearbox and day."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--gearboxes", type=int, default=1000)
    parser.add_argument("--rows", type=int, default=600)
    given = parser.parse_args()
    began = time.process_time()
    fleet = Fleet(paper(), given.gearboxes)
    error = fleet.table.error  # of all points, which it computes
    print(f"table of the type: {time.process_time() - began:.2f} s, error {error:.2%}")
    played = Played(given.gearboxes, 1)
    rows = [played.row(float(second)) for second in range(1, given.rows + 1)]
    began = time.process_time()
    for second, row in enumerate(rows, 1):
        fleet.add(float(second), row)
    used = (time.process_time() - began) / given.rows
    print(f"{given.gearboxes} gearboxes at 1 Hz: {used:.2%} of a core")
    print(f"one gearbox and day: {used * DAY / given.gearboxes:.3f} s of processor time")


main()
