"""The gears' motion between recorded angles, and their meshing."""

import numpy as np

from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.view.motion import STEPS_PER_PITCH, motion


def test_motion_passes_through_every_recorded_angle(tour):
    recording = read_recording(tour)
    moved = motion(recording)
    at = np.searchsorted(moved.time, recording.state.time - 1e-9)
    for member, recorded in (
        ("sun", recording.state["sun_angle"]),
        ("planet_2", recording.state["planet_angle"][:, 1]),
        ("ring", recording.state["ring_angle"]),
    ):
        assert np.allclose(np.exp(1j * moved.angle[member][at]), np.exp(1j * recorded), atol=1e-9)


def test_gears_turn_as_fast_as_recorded(tour):
    recording = read_recording(tour)
    moved = motion(recording)
    pitch = 2 * np.pi / 30
    assert np.abs(np.diff(moved.angle["sun"])).max() <= 1.001 * pitch / STEPS_PER_PITCH
    turned = moved.angle["sun"][-1] - moved.angle["sun"][0]
    recorded = np.unwrap(recording.state["sun_angle"])
    assert np.isclose(turned, recorded[-1] - recorded[0])
    ring = moved.angle["ring"][-1] - moved.angle["ring"][0]
    assert np.isclose(ring, -3 / 7 * turned, rtol=1e-4)
    assert np.ptp(moved.angle["carrier"]) == 0.0
