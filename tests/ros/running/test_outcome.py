"""The report at the end of `run`, from the states that are recorded."""

from dataclasses import replace
from functools import partial
from pathlib import Path

import pytest
from planetary_twin.running.outcome import Sums, read_outcome, sums_of
from twin_recording import NAMESPACE, START_NS, TwinRecording

import planetary_twin_py as pt
from planetary_twin_py.recording.container.records import files_of
from planetary_twin_py.recording.runs.schedule import messages_of

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


def test_sums_of_arriving_states_replace_reading_the_file(tmp_path):
    folder = recorded(tmp_path / "run", pt.load_scene("differential"), 20.0, -20.0)
    arriving = Sums()
    for _, state in messages_of(folder, NAMESPACE, ("gearbox_state",), []):
        arriving.add(partial(getattr, state))
    read = sums_of(files_of(folder))
    assert (arriving.states, arriving.lowest_rate) == (read.states, read.lowest_rate) == (24, 1000)
    for name in ("duration", "lost", "put_in"):
        assert getattr(arriving, name) == pytest.approx(getattr(read, name), rel=1e-12)
    doubled = replace(arriving, lost=2.0 * arriving.lost)
    outcome = read_outcome([folder], {}, {}, False, doubled)
    assert outcome.power_loss == pytest.approx(2.0 * read.lost / read.duration)
    incomplete = read_outcome([folder], {}, {}, False, replace(doubled, states=23))
    assert incomplete.power_loss == pytest.approx(read.lost / read.duration)


def test_efficiency_of_a_run_at_standstill_is_undefined(tmp_path):
    scene = pt.load_scene("paper").replace(input_speed=0.0)
    found = read_outcome([recorded(tmp_path / "run", scene, 63.0)], {}, {}, False, Sums())
    assert found.figures()["efficiency"] is None
