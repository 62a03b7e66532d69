"""Sliding changes its sense at the pitch point, and with the direction of rotation."""

import numpy as np
import pytest
from stability.sound import PAPER, sound_run

TEETH = 30
DIRECTIONS = pytest.mark.parametrize("speed", [104.72, 10.0, 1.0, -104.72])


def mesh_cycle(run, mesh=0):
    """Base pitches that the drive flanks of the first sun mesh are past the pitch point."""
    cycle = TEETH * run.angle[:, 0] / (2.0 * np.pi)
    return (cycle + 0.5) % 1.0 - 0.5


def cycles(scene, count=2.5, samples=4000):
    """A run over some mesh cycles."""
    duration = 2.0 * np.pi / TEETH / abs(scene.operating_point.input_speed)
    return sound_run(scene, count * duration, samples / duration, tolerance=1e-5)


@DIRECTIONS
def test_a_single_pair_loses_no_power_at_the_pitch_point(speed):
    run = cycles(PAPER.replace(input_speed=speed))
    cycle, loss = mesh_cycle(run), run.power_loss[:, 0]
    alone = (cycle > -0.2) & (cycle < 0.24)
    at_pitch, beside = alone & (np.abs(cycle) < 5e-4), alone & (np.abs(cycle) > 0.1)
    assert at_pitch.any() and beside.any()
    assert loss[at_pitch].max() < 0.01 * loss[beside].mean()


@DIRECTIONS
def test_beside_it_the_loss_is_friction_times_sliding(speed):
    """|rho1 w1 + rho2 w2|, where traction has reached its plateau."""
    scene = PAPER.replace(input_speed=speed)
    run, gears = cycles(scene), scene.gearset
    cycle = mesh_cycle(run)
    past = cycle * np.pi * gears.module * np.cos(gears.pressure_angle)
    lever = 0.5 * gears.module * np.sin(gears.pressure_angle)
    rho1, rho2 = lever * gears.teeth.sun + past, lever * gears.teeth.planet - past
    sliding = np.abs(rho1 * run.speed[:, 0] + rho2 * run.speed[:, 1])
    friction = run.boundary_friction[:, 0] + run.viscous_friction[:, 0]
    plateau = (cycle > 0.12) & (cycle < 0.2)
    assert plateau.any()
    assert run.power_loss[plateau, 0] == pytest.approx((friction * sliding)[plateau], rel=1e-4)


@pytest.mark.parametrize("threshold", [1e-12, 1e-6, 1e-3, 1.0])
def test_friction_as_steep_as_a_step_is_integrated(threshold):
    scene = PAPER.replace(**{"lubrication.sliding_threshold": threshold})
    run = sound_run(scene, 0.004, tolerance=1e-4)
    assert run.stats.steps < 20_000
