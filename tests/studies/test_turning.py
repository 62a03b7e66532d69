"""Points of a study whose gears turn too little for means, or at another speed, are reported."""

import math

import pytest
from studies.small import PAPER

import planetary_twin_py as pt
from planetary_twin_py.explanation.turning import turning_warnings
from planetary_twin_py.model.layout import Layout
from planetary_twin_py.simulation.threads import Threads
from planetary_twin_py.studies.axes import Axis
from planetary_twin_py.studies.plan import Settings, grid
from planetary_twin_py.studies.stribeck import stribeck
from planetary_twin_py.studies.sweep import sweep
from planetary_twin_py.studies.turning import speed_share, turning_of_study

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


def test_gears_that_stick_show_in_the_table_of_a_sweep():
    """Slow gears under load stop where the mesh gets stiffer, until the loop pushes them on."""
    scene = PAPER.replace(input_torque=150.0)
    settings = Settings(duration=0.6, settling=0.6)
    table = sweep(grid(scene, [Axis("input_speed", (pt.rpm(10.0),))], settings), Threads())
    (share,), (found,) = table["speed_share"].to_pylist(), table["mesh_frequency"].to_pylist()
    assert share == pytest.approx(found / 5.0, rel=1e-9)
    assert abs(share - 1.0) > 0.05
    assert any("speed_share" in line for line in turning_of_study(table))


def test_a_run_up_has_no_share():
    scene = PAPER.replace(**{"drive.speed_control.start_speed": 0.0})
    assert Layout(scene).mesh_frequency == pytest.approx(500.0)
    assert math.isnan(speed_share(scene, 250.0))
    assert speed_share(PAPER, 250.0) == pytest.approx(0.5)


def test_a_stribeck_curve_has_whole_mesh_cycles():
    table = stribeck(PAPER, Axis("input_speed", (0.01, 1.0)), Threads(), lambda *_: None)
    assert table["speed_share"].to_pylist() == pytest.approx([1.0, 1.0])
    assert list(turning_of_study(table)) == []
