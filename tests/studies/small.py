"""A study small enough to be run repeatedly."""

import planetary_twin_py as pt
from planetary_twin_py.studies.axes import Axis
from planetary_twin_py.studies.plan import Settings, grid

PAPER = pt.load_scene("paper")
QUICK = Settings(duration=0.02, settling=0.01, sample_rate=20_000.0, tolerance=1e-3)
AXES = [Axis("input_torque", (0.3, 20.0, 63.0)), Axis("lambda_ratio", (1.0, 2.0))]
STUDY = grid(PAPER, AXES, QUICK)
