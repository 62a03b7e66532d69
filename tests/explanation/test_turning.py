"""Runs of less than a mesh cycle, and at another speed than asked for, are reported."""

import re

import pytest

import planetary_twin_py as pt
from planetary_twin_py.explanation.turning import duration_for_means, turning_warnings

PAPER = pt.load_scene("paper")  # 30 teeth of the sun, carrier held: 500 Hz at 1000 rpm


@pytest.mark.parametrize("dynamics", ["torsional", "quasi_static"])
def test_less_than_a_mesh_cycle_is_reported_with_the_time_of_one(dynamics):
    scene = PAPER.replace(input_speed=pt.rpm(1000.0), dynamics=dynamics)
    (line,) = turning_warnings(scene, pt.simulate(scene, 0.001))
    (covered,) = re.findall(r"covers ([\d.]+) of a mesh cycle", line)
    assert float(covered) == pytest.approx(0.5, rel=0.03)  # vibration changes the mean speed
    assert "takes 0.002 s" in line
    assert list(turning_warnings(scene, pt.simulate(scene, 0.004))) == []


@pytest.mark.parametrize("dynamics", ["torsional", "quasi_static"])
def test_few_cycles_are_reported_with_better_durations(dynamics):
    scene = PAPER.replace(input_speed=pt.rpm(1000.0), dynamics=dynamics)
    (line,) = turning_warnings(scene, pt.simulate(scene, 0.00294))
    assert "duration = 0.00294 s is 1.47 mesh cycles" in line
    assert "use 0.004 s (2 cycles), or 0.02 s and more" in line
    for better in (0.004, 0.0204):
        assert list(turning_warnings(scene, pt.simulate(scene, better))) == []


@pytest.mark.parametrize(
    ("speed", "duration"), [(1000.0, 0.1), (100.0, 0.1), (25.0, 0.16), (0.1, 0.1), (0.0, 0.1)]
)
def test_a_duration_for_means_is_short_and_has_whole_cycles(speed, duration):
    scene = PAPER.replace(input_speed=pt.rpm(speed))
    assert duration_for_means(scene) == pytest.approx(duration)


def test_mean_speed_that_speed_loop_does_not_hold_is_reported():
    """Slow gears under load stop where the mesh gets stiffer, until the loop pushes them on."""
    scene = PAPER.replace(input_speed=pt.rpm(10.0), input_torque=150.0)
    run = pt.simulate(scene, 0.6, 1000.0, settling=0.6)
    share = abs(run.mean_speed[run.bodies.index("sun")]) / pt.rpm(10.0)
    assert abs(share - 1.0) > 0.05
    (line,) = turning_warnings(scene, run)
    assert f"turn at {share:.3g} of the speed" in line
