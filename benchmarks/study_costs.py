"""What a study costs: sweeps over torques, a map, a tolerance study of pins.

python benchmarks/study_costs.py: processor time of each, in a fresh process. Compare checkouts on
one machine, and there the ratios.
"""

from __future__ import annotations

import subprocess
import sys
import time

import numpy as np

import planetary_twin_py as pt
from planetary_twin_py.simulation.threads import Threads
from planetary_twin_py.statics.load_sharing import load_sharing
from planetary_twin_py.studies.axes import Axis
from planetary_twin_py.studies.plan import Settings, grid
from planetary_twin_py.studies.sweep import sweep

# Teeth computed from their geometry, whose contact feels the torque.
INVOLUTE = pt.load_scene("cracked_tooth").replace(faults=[], dynamics="quasi_static")


def _axis(field: str, count: int) -> Axis:
    full = getattr(INVOLUTE.operating_point, field)
    return Axis(field, tuple(np.linspace(0.5 * full, full, count).tolist()))


def sweep_of(torques: int, speeds: int, duration: float) -> None:
    """Simulate a grid in which torque varies fastest."""
    axes = [_axis("input_speed", speeds), _axis("input_torque", torques)]
    sweep(grid(INVOLUTE, axes, Settings(duration)), Threads(1))


def tolerance_study() -> None:
    """Share the load among planets on 100 sets of pins."""
    scene, draw = pt.load_scene("floating_sun"), np.random.default_rng(1)
    for error in draw.normal(0.0, 5e-6, (100, scene.gearset.planets)).tolist():
        load_sharing(scene.replace(**{"errors.pin_tangential": error}))


STUDIES = {
    "16 torques, 3 speeds": lambda: sweep_of(16, 3, 0.01),
    "17 torques, 3 speeds": lambda: sweep_of(17, 3, 0.01),
    "40 torques, 3 speeds": lambda: sweep_of(40, 3, 0.01),
    "map of 20 x 20": lambda: sweep_of(20, 20, 0.2),
    "load sharing on 100 sets of pins": tolerance_study,
}


def main() -> None:
    """Measure all, or the one that is named."""
    if len(sys.argv) > 1:
        begin = time.process_time()
        STUDIES[sys.argv[1]]()
        print(f"{sys.argv[1]}: {time.process_time() - begin:.2f} s")
        return
    for name in STUDIES:
        subprocess.run([sys.executable, __file__, name], check=True)


if __name__ == "__main__":
    main()
