"""What a friction table costs: speed of a run beside the built-in law.

python benchmarks/friction_table.py [ROUNDS]: simulated time over processor time of `paper`, without
repetition and samples; the median of the rounds, and their spread.
"""

from __future__ import annotations

import sys
import time
from statistics import median

import numpy as np

import planetary_twin_py as pt

DURATION, TOLERANCE = 1.0, 1e-3
GRIDS = {
    "lambda_ratio": np.geomspace(0.05, 5.0, 10),
    "pressure": np.geomspace(1e7, 2e9, 10),
    "sliding_speed": np.geomspace(1e-3, 3.0, 10),
}


def law(**quantities: float) -> float:
    """Film and boundary friction by load sharing, in as many quantities as are given."""
    share = min(0.82 * quantities.get("lambda_ratio", 1.0) ** 0.28, 1.0)
    return 0.04 * share + 0.11 * (1.0 - share) + 0.001 * quantities.get("sliding_speed", 0.0)


def scenes() -> dict[str, pt.Scene]:
    """`paper` with the built-in law, and with tables over none to three quantities."""
    paper = pt.load_scene("paper").replace(**{"lubrication.traction": "eyring"})
    found = {"eyring, load sharing": paper}
    for count in range(len(GRIDS) + 1):
        table = pt.friction_table(law, **dict([*GRIDS.items()][:count]))
        changes = {"lubrication.traction": "table", "lubrication.friction_table": table}
        found[f"table over {count} quantities"] = paper.replace(**changes)
    return found


def main() -> None:
    """Measure all, by turns."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    factors = dict[str, list[float]]()
    for _ in range(rounds):
        for name, scene in scenes().items():
            begin = time.process_time()
            pt.simulate(scene, DURATION, 1.0, "march", TOLERANCE)
            factors.setdefault(name, []).append(DURATION / (time.process_time() - begin))
    own = median(factors["eyring, load sharing"])
    for name, values in factors.items():
        spread = f"{median(values):.1f} ({min(values):.1f} to {max(values):.1f})"
        print(f"{name}: {spread} times real time, {median(values) / own:.2f} of the built-in law")


if __name__ == "__main__":
    main()
