"""Points of a study whose gears turn too little for means, or at another speed, are reported."""

import pytest
from studies.small import PAPER

import planetary_twin_py as pt
from planetary_twin_py.explanation.turning import turning_warnings
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


@pytest.mark.parametrize("duration", [0.03, 0.0294])
def test_points_of_few_cycles_are_reported_as_a_run_is(duration):
    """50 Hz at 100 rpm: 1.5 cycles; 15 at 1000 rpm are enough."""
    (line,) = turning_of_study(of_speeds(duration))
    few = f"{50.0 * duration:.3g}"
    assert line.startswith(f"1 of 3 points cover few mesh cycles and a part of one, down to {few}")
    assert "use --duration 0.2s and more" in line
    slow = PAPER.replace(input_speed=pt.rpm(100.0))
    (of_run,) = turning_warnings(slow, pt.simulate(slow, duration))
    reason = "means of losses, forces and DTE depend on where the teeth are, unless the number"
    assert reason in line and reason in of_run
    assert list(turning_of_study(of_speeds(0.2))) == []
