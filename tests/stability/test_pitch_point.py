"""Sliding changes its sense at the pitch point, and with the direction of rotation."""

import numpy as np
import pytest
from stability.sound import PAPER, sound_run

TEETH = 30
DIRECTIONS = pytest.mark.parametrize("speed", [104.72, 10.0, 0.1, -104.72])


def mesh_cycle(run, mesh=0):
    """Base pitches that the drive flanks of the first sun mesh are past the pitch point."""
    cycle = TEETH * run.angle[:, 0] / (2.0 * np.pi)
    return (cycle + 0.5) % 1.0 - 0.5


@DIRECTIONS
def test_at_the_pitch_point_a_pair_alone_takes_no_power_and_beside_it_takes_some(speed):
    run = sound_run(PAPER.replace(input_speed=speed), 2.5 * 0.2094 / abs(speed), tolerance=1e-5,
                    sample_rate=4000.0 * abs(speed) / 0.2094)  # fmt: skip
    cycle, loss = mesh_cycle(run), run.power_loss[:, 0]
    alone = (cycle > -0.2) & (cycle < 0.24)
    at_pitch, beside = alone & (np.abs(cycle) < 5e-4), alone & (np.abs(cycle) > 0.1)
    assert at_pitch.any() and beside.any()
    assert loss[at_pitch].max() < 0.01 * loss[beside].mean()


@DIRECTIONS
def test_power_lost_near_the_pitch_point_is_friction_times_sliding(speed):
    """Vs = (w1 + w2) s beside it, where the traction has reached its plateau."""
    scene = PAPER.replace(input_speed=speed)
    run = sound_run(scene, 2.5 * 0.2094 / abs(speed), tolerance=1e-5,
                    sample_rate=4000.0 * abs(speed) / 0.2094)  # fmt: skip
    cycle = mesh_cycle(run)
    plateau = (cycle > 0.12) & (cycle < 0.2)
    pitch = np.pi * scene.gearset.module * np.cos(scene.gearset.pressure_angle)
    turning = np.abs(run.speed[:, 0] - run.speed[:, 1])
    friction = run.boundary_friction[:, 0] + run.viscous_friction[:, 0]
    expected = (friction * turning * np.abs(cycle) * pitch)[plateau]
    assert run.power_loss[plateau, 0] == pytest.approx(expected, rel=1e-2)


def test_friction_that_changes_its_sense_at_the_pitch_point_needs_no_flood_of_steps():
    with_friction = sound_run(PAPER, 0.02, tolerance=1e-4).stats
    without = sound_run(
        PAPER.replace(**{"lubrication.friction": False}), 0.02, tolerance=1e-4
    ).stats
    assert with_friction.steps < 2 * without.steps


@pytest.mark.parametrize("threshold", [1e-12, 1e-6, 1e-3, 1.0])
def test_friction_as_steep_as_a_step_is_passed(threshold):
    scene = PAPER.replace(**{"lubrication.sliding_threshold": threshold})
    run = sound_run(scene, 0.004, tolerance=1e-4)
    assert run.stats.steps < 20_000
