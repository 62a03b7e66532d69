"""Standing still, and starting from there."""

from dataclasses import replace

import numpy as np
import pytest
from stability.sound import (
    PAPER,
    PLAIN,
    UNIFORM,
    base_radius,
    behind_the_sun,
    sound_run,
    static_force,
    static_torsion,
    stiffnesses,
)

import planetary_twin_py as pt
from planetary_twin_py.run.result import Energy

EITHER_LAW = pytest.mark.parametrize("law", ["viscous", "printed_meshing_frequency"])


@EITHER_LAW
@pytest.mark.parametrize("torque", [63.0, -63.0, 1e-3])
def test_standing_under_torque_the_teeth_are_bent_as_statics_say(law, torque):
    """DTE = F/k + b/2 towards the flank that carries."""
    scene = UNIFORM.replace(input_speed=0.0, input_torque=torque, **{"mesh.damping.law": law})
    run = sound_run(scene, 0.05)
    force = static_force(scene)
    assert run.mesh_force[-1] == pytest.approx(force, rel=1e-6)
    expected = force / stiffnesses(scene) + np.copysign(0.5 * scene.operating_point.backlash, force)
    assert run.dte[-1] == pytest.approx(expected, rel=1e-6)
    assert np.abs(run.speed).max() < 1e-3  # an error of 1e-11 m at 10 kHz and 11 mm


def test_standing_friction_carries_no_torque_and_no_power():
    """Whatever stiffness the meshes have, the sum of their forces is the torque of the motor."""
    run = sound_run(PAPER.replace(input_speed=0.0), 0.1)
    assert run.mesh_force[-1, :3].sum() == pytest.approx(3.0 * static_force(PAPER), rel=1e-4)
    assert run.power_loss[-1].sum() < 1e-9


@pytest.mark.parametrize("torque", [-63.0, 0.5])
def test_standing_still_there_is_no_efficiency(torque):
    """Work of the motors that is a rounding error of the stored energy has no losses."""
    scene = PAPER.replace(input_speed=0.0, input_torque=torque)
    assert np.isnan(pt.simulate(scene, 0.1).efficiency)
    assert np.isnan(pt.Twin(scene).advance(0.1).efficiency)


def test_at_rest_work_that_is_only_stored_has_no_efficiency():
    """A ring rocks in its clearance, and winds up the shaft of a motor that holds speed zero."""
    rocking = Energy(
        machines=(6.044e-8, 0.0),
        kinetic=2.7e-11,
        elastic=5.985e-8,
        friction=7.5e-11,
        damping=4.8e-10,
        bearing=0.0,
        churning=0.0,
        stiffness_work=0.0,
        stored=12.99,
    )
    assert not rocking.driven
    assert replace(rocking, elastic=0.0, machines=(6.044e-8, -5.9e-8)).driven


@EITHER_LAW
@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_from_standstill_the_sun_follows_the_set_point(law, direction):
    """angle = slew t^2/2; the twist of the shaft is the difference."""
    slew = 500.0
    scene = PLAIN.replace(
        input_speed=direction * pt.rpm(1000),
        **{"drive.speed_control.start_speed": 0.0, "mesh.damping.law": law},
    )
    run = sound_run(scene, 0.1)
    torsion = static_torsion(scene)
    gone = run.angle[:, 0] - run.angle[0, 0]
    assert gone == pytest.approx(direction * 0.5 * slew * run.time**2, abs=0.2 * torsion)


@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_starting_with_friction_takes_power_from_first_moment_on(direction):
    scene = PAPER.replace(
        input_speed=direction * pt.rpm(1000), **{"drive.speed_control.start_speed": 0.0}
    )
    run = sound_run(scene, 0.1, tolerance=1e-5)
    loss = run.power_loss.sum(axis=1)
    assert run.energy.friction == pytest.approx(loss.mean() * run.time[-1], rel=1e-2)
    assert 0.0 < loss[:20].mean() < 0.1 * loss[-200:].mean()


# Teeth that an error of form wedges in, and that friction brings to rest.
JAMMED = PAPER.replace(
    input_speed=0.0,
    **{
        "mesh.damping.law": "natural_frequency",
        "mesh.sun_planet_error": {"amplitudes": [1e-4]},
        "drive.speed_control.bandwidth": 30.0,
    },
)


def test_jammed_teeth_come_to_rest_at_the_live_tolerance():
    """What friction takes on the way is that of a tight tolerance: bristles hold the flanks."""
    *live, tight = (
        pt.simulate(JAMMED, 0.02, 20_000.0, tolerance=tolerance).energy.friction  # [J]
        for tolerance in (1e-2, 4.9e-3, 5e-3, 5.1e-3, 1e-6)  # one may be right by chance
    )
    assert live == pytest.approx([tight] * 4, rel=2e-3)


def test_damping_at_standstill_lets_go_as_gears_turn():
    """q' = (F/k - q)/tau, tau = c/f_m, f_m = Zs slew t/(2 pi): q nears F/k as exp(-t^2)."""
    slew, loss_factor = 500.0, 0.009
    stiff = {f"drive.{side}.coupling_stiffness": 1e6 for side in ("input", "output")}
    damped = {"drive.input.coupling_damping": 30.0, "drive.output.coupling_damping": 300.0}
    law = {"mesh.damping.law": "meshing_frequency", "mesh.damping.loss_factor": loss_factor}
    scene = PLAIN.replace(
        **stiff, **damped, **law,
        **{"mesh.damping.lowest_frequency": 1e-6, "drive.speed_control.start_speed": 0.0},
    )  # fmt: skip
    run = sound_run(scene, 0.01)
    teeth, arm = scene.gearset.teeth.sun, base_radius(scene, scene.gearset.teeth.sun)
    more = slew * behind_the_sun(scene) / (scene.gearset.planets * arm)
    left = np.exp(-teeth * slew * run.time**2 / (4.0 * np.pi * loss_factor))
    expected = (
        0.5 * scene.operating_point.backlash
        + (static_force(scene) + more * (1.0 - left)) / stiffnesses(scene)[0]
    )
    assert run.dte[:, 0] == pytest.approx(expected, abs=0.1 * more / stiffnesses(scene)[0])
