"""The report at the end of `run`, from the states that are recorded."""

from pathlib import Path

import pytest
from planetary_twin.running.outcome import Sums, read_outcome
from twin_recording import START_NS, TwinRecording

import planetary_twin_py as pt

WINDOW = 0.01


def recorded(folder: Path, scene: pt.Scene, *torques: float) -> Path:
    """A run with each of `torques` [N m] of the motor for as long."""
    recording, twin = TwinRecording(folder), pt.Twin(scene, 1000.0)
    recording.begin(twin, START_NS)
    for torque in torques:
        twin.set(input_torque=torque)
        for _ in range(12):
            recording.advance(twin, WINDOW)
    recording.finish()
    return folder


def efficiency_of(scene: pt.Scene, *torques: float) -> float:
    """1 - loss over the sum of the work that each machine puts in, window by window."""
    twin, lost, put_in = pt.Twin(scene, 1000.0), 0.0, 0.0
    for torque in torques:
        twin.set(input_torque=torque)
        for _ in range(12):
            window = twin.advance(WINDOW)
            lost += window.power_loss
            put_in += sum(max(power, 0.0) for power in window.machine_power)
    return 1.0 - lost / put_in


@pytest.mark.parametrize("name", ["paper", "differential"])
def test_efficiency_counts_power_at_any_shaft(tmp_path, name):
    scene = pt.load_scene(name)
    torque = scene.operating_point.input_torque
    found = read_outcome(
        [recorded(tmp_path / "run", scene, torque, -torque)], {}, {}, False, Sums()
    )
    assert found.efficiency == pytest.approx(efficiency_of(scene, torque, -torque), rel=1e-9)
    assert 0.9 < found.efficiency < 1.0


def test_efficiency_of_a_run_at_standstill_is_undefined(tmp_path):
    scene = pt.load_scene("paper").replace(input_speed=0.0)
    found = read_outcome([recorded(tmp_path / "run", scene, 63.0)], {}, {}, False, Sums())
    assert found.figures()["efficiency"] is None
