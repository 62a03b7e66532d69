"""No damping at all, and so much that teeth creep into place."""

import numpy as np
import pytest
from stability.linear_train import LinearTrain
from stability.sound import PLAIN, sound_run, static_force, stiffnesses

import planetary_twin_py as pt

LOOSE = {
    "drive.speed_control.bandwidth": 1e-6,
    "drive.input.coupling_damping": 0.0,
    "drive.output.coupling_damping": 0.0,
}
BEFORE, STEP = 40.0, 20.0  # [N m]


def after_step(scene, duration, tolerance):
    """Growth of the DTE after a step of the torque, while flanks stay together, and its times."""
    twin = pt.Twin(scene.replace(input_speed=0.0, input_torque=BEFORE), tolerance=tolerance)
    rest = twin.advance(1e-4).waveform.dte[-1]
    begin = twin.set(input_torque=BEFORE + STEP)
    wave = twin.advance(duration).waveform
    assert wave.mesh_force.min() > 0.0
    return wave.dte - rest, wave.time - begin


def test_without_damping_every_mode_keeps_swinging_as_it_began():
    """Modal superposition, over a hundred periods of the lowest mode of the teeth."""
    scene = PLAIN.replace(**LOOSE, **{"mesh.damping.damping_ratio": 0.0})
    grown, times = after_step(scene, 0.02, 1e-8)
    train = LinearTrain(scene)
    exact = train.after_step(STEP, times)
    assert np.ptp(exact[-200:]) > 0.1 * np.ptp(exact)
    assert grown == pytest.approx(exact, abs=1e-3 * np.abs(exact).max())


def test_without_damping_and_friction_no_energy_is_lost():
    scene = PLAIN.replace(**LOOSE, torque_ripple=20.0, **{"mesh.damping.damping_ratio": 0.0})
    run = sound_run(scene, 0.05)
    assert run.energy.damping == run.energy.friction == run.energy.loss == 0.0
    swung = run.energy.kinetic + run.energy.elastic
    kept = run.energy.input - run.energy.output
    assert kept == pytest.approx(swung, abs=1e-5 * run.energy.driving_work)


@pytest.mark.parametrize("ratio", [0.5, 1.0, 2.0])
def test_damped_heavily_step_response_is_that_of_linear_train(ratio):
    scene = PLAIN.replace(**LOOSE, **{"mesh.damping.damping_ratio": ratio})
    grown, times = after_step(scene, 0.01, 1e-7)
    exact = LinearTrain(scene).after_step(STEP, times)
    assert grown == pytest.approx(exact, abs=1e-3 * np.abs(exact).max())


@pytest.mark.parametrize("tau", [1e-3, 1e-2, 1.0])
def test_overdamped_teeth_relax_with_time_constant_of_damping(tau):
    """q = F/k (1 - exp(-t/tau)) where inertia has no say."""
    stiff = {f"drive.{side}.coupling_stiffness": 1e6 for side in ("input", "output")}
    damped = {"drive.input.coupling_damping": 30.0, "drive.output.coupling_damping": 300.0}
    law = {
        "mesh.damping.law": "meshing_frequency",
        "mesh.damping.loss_factor": 1.0,
        "mesh.damping.lowest_frequency": 1.0 / tau,
    }
    scene = PLAIN.replace(**LOOSE).replace(**stiff, **damped, **law)
    grown, times = after_step(scene, 0.05, 1e-7)
    more = static_force(scene.replace(input_torque=STEP)) / stiffnesses(scene)
    expected = more * (1.0 - np.exp(-times / tau))[:, None]
    late = times > 5e-3
    assert grown[late] == pytest.approx(expected[late], rel=2e-2)
