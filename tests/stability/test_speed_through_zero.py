"""The speed changes its sign, where damping by the meshing frequency has no value of its own."""

import numpy as np
import pytest
from stability.sound import (
    LAWS,
    PAPER,
    PLAIN,
    base_radius,
    behind_the_sun,
    sound_run,
    static_force,
    static_torsion,
)

SLEW, SPEED = 500.0, 20.0  # [rad/s^2], [rad/s]
CROSSING = SPEED / SLEW
BOTH_WAYS = pytest.mark.parametrize("direction", [1.0, -1.0])
EVERY_LAW = pytest.mark.parametrize("law", LAWS)
# As low as the frequency of a mesh may be for the damping to follow it.
FLOOR = {"mesh.damping.lowest_frequency": 1e-6}


def ramp(scene, direction, law):
    return scene.replace(
        input_speed=direction * SPEED,
        **{"drive.speed_control.start_speed": -direction * SPEED, "mesh.damping.law": law},
    )


@BOTH_WAYS
@pytest.mark.parametrize("law", ["viscous", "printed_meshing_frequency"])
def test_the_way_back_mirrors_the_way_there(direction, law):
    """Under a constant slew the angle is a parabola about the instant of standstill."""
    scene = ramp(PAPER.replace(**{"lubrication.friction": False}), direction, law)
    run = sound_run(scene, 2 * CROSSING)
    from_crossing = run.time - CROSSING
    parabola = direction * 0.5 * SLEW * from_crossing**2
    swing = run.angle[:, 0] - parabola
    assert np.ptp(swing) < 0.2 * static_torsion(scene)
    assert np.sign(run.speed[[0, -1], 0]).tolist() == [-direction, direction]


@BOTH_WAYS
@EVERY_LAW
def test_the_mesh_force_is_that_of_the_acceleration(direction, law):
    """The sun's teeth carry the motor's torque and accelerate all that is behind them."""
    quiet = {
        "drive.input.coupling_damping": 3.0,
        "drive.output.coupling_damping": 16.0,
        "drive.speed_control.bandwidth": 1e-3,
    }
    scene = ramp(PLAIN.replace(**quiet), direction, law)
    run = sound_run(scene, 2 * CROSSING)
    arm = scene.gearset.planets * base_radius(scene, scene.gearset.teeth.sun)
    accelerating = direction * SLEW * behind_the_sun(scene) / arm
    near = np.abs(run.time - CROSSING) < 0.25 * CROSSING
    force = run.mesh_force[near, : scene.gearset.planets]
    assert force == pytest.approx(static_force(scene) + accelerating, rel=1e-3)


@BOTH_WAYS
@pytest.mark.parametrize("law", ["meshing_frequency", "printed_meshing_frequency"])
def test_damping_that_grows_towards_standstill_is_passed(direction, law):
    run = sound_run(ramp(PAPER.replace(**FLOOR), direction, law), 2 * CROSSING)
    assert run.mesh_force.min() > 0.0
    assert run.stats.steps < 40_000  # most resolve how friction reverses, see below
