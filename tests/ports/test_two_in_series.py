"""Two gearboxes in series, each a twin, against closed forms of the two-stage train.

The output of the first moves the input of the second, whose torque acts back one step later.
"""

import math

import numpy as np
import pytest
from ports.ports_of_paper import PAPER, RATIO, at_rest, inertia_at_input

import planetary_twin_py as pt

TORQUE = 3.0  # [N m]
DAMPED = {"drive.input.coupling_damping": 5.0, "drive.output.coupling_damping": 30.0}
BASE_RADIUS = 0.4e-3 * 30 * math.cos(PAPER.gearset.pressure_angle)  # of the sun [m]


def pair(output, **changes):
    """Both twins; `output` is the port of the second's output."""
    scenes = at_rest("torque", "torque", **changes), at_rest("motion", output, **changes)
    return tuple(pt.Twin(scene, tolerance=1e-4) for scene in scenes)


def step(twins, dt, back, torque, **given):
    """Exchange once; returns both states, and the torque that acts back."""
    first, second = twins
    front = first.step(dt, input_torque=torque, output_torque=back)
    behind = second.step(dt, input_speed=front.output_speed, **given)
    return front, behind, -behind.input_torque


def angles(states):
    """Angles of input and output of each stage [rad], (stages, 2)."""
    return np.array([(state.input_angle, state.output_angle) for state in states])


def test_a_free_train_of_two_stages_speeds_up_as_a_rigid_one():
    twins, back, dt = pair("torque"), 0.0, 2e-4
    for _ in range(round(0.2 / dt)):
        front, behind, back = step(twins, dt, back, TORQUE, output_torque=0.0)
    one, other = twins
    # What moves the input of the second is the flange of the first, which counts once.
    second = inertia_at_input(other.scene, without=("motor",))
    inertia = inertia_at_input(one.scene) + RATIO**2 * second
    swing = TORQUE / inertia / math.sqrt(500.0 / 0.05)  # acceleration over the slowest shaft mode
    speed = 0.2 * TORQUE / inertia
    assert front.input_speed == pytest.approx(speed, abs=swing)
    assert behind.output_speed == pytest.approx(RATIO**2 * speed, abs=swing)


def test_a_locked_train_twists_as_its_springs_in_series():
    twins, back = pair("motion", **DAMPED), 0.0
    touching = [twin.advance(2e-5).waveform.dte[-1] for twin in twins]  # drive flanks just touch
    start = angles(step(twins, 2e-4, back, 0.0, output_speed=0.0)[:2])
    for torque in np.linspace(0.0, 30.0, 1001)[1:]:
        *_, back = step(twins, 2e-4, back, float(torque), output_speed=0.0)
    for _ in range(6000):
        *end, back = step(twins, 2e-4, back, 30.0, output_speed=0.0)
    torques = (30.0, 30.0 / -RATIO)  # at both inputs
    assert back == pytest.approx(torques[1], rel=1e-6)
    assert end[1].output_torque == pytest.approx(torques[1] / RATIO, rel=1e-6)
    twists = []
    for twin, torque, before in zip(twins, torques, touching, strict=True):
        # The second stage is turned backwards, through the backlash to its coast flanks.
        sun_mesh, ring_mesh = np.abs(twin.advance(1e-4).waveform.dte[-1] - before)[[0, 3]]
        yielded = (sun_mesh + ring_mesh) / BASE_RADIUS
        twists.append(torque / 500.0 + torque / RATIO**2 / 3000.0 + yielded)
    (front, turned), (behind, held) = angles(end) - start
    assert front - turned / RATIO == pytest.approx(twists[0], rel=1e-6)
    assert behind - held / RATIO == pytest.approx(-twists[1], rel=1e-6)
    # The second stage turns the output of the first, backwards and by 3/7 of its input. The speed
    # that is handed over is held for a step each time.
    assert front == pytest.approx(twists[0] + twists[1] / -RATIO, rel=2e-5)
