"""Points of a study whose gears turn too little for means, or at another speed, are reported."""

from studies.small import PAPER

import planetary_twin_py as pt
from planetary_twin_py.simulation.threads import Threads
from planetary_twin_py.studies.axes import Axis
from planetary_twin_py.studies.plan import Settings, grid
from planetary_twin_py.studies.sweep import sweep
from planetary_twin_py.studies.turning import turning_of_study

SPEEDS = Axis("input_speed", (0.0, pt.rpm(100.0), pt.rpm(1000.0)))


def of_speeds(duration):
    return sweep(grid(PAPER, [SPEEDS], Settings(duration=duration, settling=0.0)), Threads())


def test_points_below_a_mesh_cycle_are_reported_standstill_not():
    """500 Hz at 1000 rpm."""
    (line,) = turning_of_study(of_speeds(0.004))
    assert line.startswith("1 of 3 points cover less than a mesh cycle, down to 0.1")
    assert list(turning_of_study(of_speeds(0.04))) == []
