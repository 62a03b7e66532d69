"""The gears' motion between recorded angles, and their meshing."""

import numpy as np
from synthetic_recording import write_recording

from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.view.motion import STEPS_PER_PITCH, motion


def test_motion_passes_through_every_recorded_angle(tmp_path):
    recording = read_recording(write_recording(tmp_path / "a.mcap", 1.0))
    moved = motion(recording)
    at = np.searchsorted(moved.time, recording.state.time - 1e-9)
    for member, recorded in (
        ("sun", recording.state["sun_angle"]),
        ("planet_2", recording.state["planet_angle"][:, 1]),
        ("ring", recording.state["ring_angle"]),
    ):
        assert np.allclose(np.exp(1j * moved.angle[member][at]), np.exp(1j * recorded), atol=1e-9)


def test_gears_turn_as_fast_as_recorded(tmp_path):
    recording = read_recording(write_recording(tmp_path / "a.mcap", 1.0))
    moved = motion(recording)
    pitch = 2 * np.pi / 30
    assert np.abs(np.diff(moved.angle["sun"])).max() <= 1.001 * pitch / STEPS_PER_PITCH
    turned = moved.angle["sun"][-1] - moved.angle["sun"][0]
    expected = (0.74 * 1000 + 0.25 * 2000) / 60 * 2 * np.pi
    assert np.isclose(turned, expected)
    assert np.isclose(moved.angle["ring"][-1] - moved.angle["ring"][0], -3 / 7 * expected)
    assert np.ptp(moved.angle["carrier"]) == 0.0
