"""The Rerun file is valid by Rerun's own check, and contains what the layout shows."""

import numpy as np
import pytest
from twin_recording import without, write_recording
from view.entity_rows import rerun

from planetary_twin_py.recording.container.records import RecordingError
from planetary_twin_py.recording.ros2.topics import ORIGIN
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.scene import load_scene
from planetary_twin_py.view.events import sentence
from planetary_twin_py.view.show import save, scene_of


@pytest.fixture(scope="module")
def recording(tour):
    return read_recording(tour)


def test_rerun_verifies_the_file(tmp_path):
    file = write_recording(tmp_path / "a.mcap", 0.25, sample_rate=2000.0)
    recording = read_recording(file)
    scene, remark = scene_of(recording)
    assert remark is None
    rrd = tmp_path / "one.rrd"
    (remark,) = save(recording, scene, rrd)  # its DTE has lines above 1 kHz
    assert "too low for this signal" in remark
    assert "without error" in rerun("verify", rrd)
    printed = rerun("print", "-vv", rrd)
    for entity in (
        "/gears/sun",
        "/gears/ring",
        "/gears/carrier/pin_3/planet_3",
        "/gears/carrier/contact/planet_ring_3",
        "/gears/tooth_load/scale",
        "/mesh/dte_mean",
        "/mesh/viscous_friction",
        "/train/efficiency",
        "/range/mesh_force",
        "/waveform/dte",
        "/operating_point/backlash",
        "/changes",
    ):
        assert entity in printed
    assert "simulated_time" in printed
    assert "ros_time" in printed


def test_without_a_scene_missing_gears_are_reported(tmp_path):
    file = write_recording(tmp_path / "a.mcap", 0.05, without(ORIGIN))
    recording = read_recording(file)
    scene, remark = scene_of(recording)
    assert scene is None
    assert "has no scene" in remark
    save(recording, scene, tmp_path / "a.rrd")
    printed = rerun("print", tmp_path / "a.rrd")
    assert "/mesh/dte_mean" in printed
    assert "/gears" not in printed


def test_a_scene_of_another_gearbox_is_refused(recording, tmp_path):
    angles = tuple(2 * np.pi * k / 5 for k in range(5))
    other = load_scene("paper").replace(**{"gearset.planet_angles": angles})
    with pytest.raises(RecordingError, match="has 5 planets, but the recording has 3"):
        save(recording, other, tmp_path / "a.rrd")


def test_changes_are_listed_with_old_and_new_value(recording):
    assert sentence(recording, 0).startswith("initial: backlash = 0.2 µm, lambda_ratio = 1, ")
    assert sentence(recording, 2) == "lambda_ratio = 2, was 1.5; input_speed = 2000 rpm, was 1000"
    assert sentence(recording, 3) == "backlash = 0.35 µm, was 0.2"


def test_details_are_shown_where_something_happens(recording, tmp_path, monkeypatch):
    monkeypatch.setattr("planetary_twin_py.view.detail.MOST_SAMPLES", 20_000)  # 0.4 s
    (remark,) = save(recording, None, tmp_path / "a.rrd")
    assert remark.startswith("single samples are shown for the start and the changes (0.4 s of 1.0")
    (remark,) = save(recording, None, tmp_path / "b.rrd", detail=(0.3, 0.5))
    assert remark.startswith("single samples are shown for 0.3 to 0.5 s (0.2 s of 1.0 s)")
