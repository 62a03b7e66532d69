"""Angles modulo a turn become continuous again."""

import numpy as np

from planetary_twin_py.recording.runs.unwrapping import unwrap


def test_unwrapping_follows_the_speed_over_lost_messages():
    time = np.array([0.0, 0.01, 0.02, 0.09, 0.1])
    speed = np.full(5, -700.0)
    angle = np.mod(1.0 + speed * time, 2 * np.pi)
    assert np.allclose(unwrap(time, angle, speed), 1.0 + speed * time)
