"""A step of the torque against an exact solution, at steps far beyond those of explicit methods.

The model is self-written; its damping is that of the scene at 1000 rpm, tau = 0.009/f_m.
"""

import numpy as np
import pytest
from stability.linear_train import LinearTrain
from stability.sound import PLAIN

import planetary_twin_py as pt

BEFORE, STEP, SPAN = 40.0, 20.0, 4e-3  # [N m], [N m], [s]
TAU = 0.009 / 500.0  # [s]
FREE = PLAIN.replace(input_torque=BEFORE, **{"drive.speed_control.bandwidth": 1e-6})
# The ratio that gives the meshes of the sun this tau at any speed.
SCENE = FREE.replace(
    input_speed=pt.rpm(1000),
    **{
        "mesh.damping.damping_ratio": FREE.mesh.damping.damping_ratio
        * TAU
        / LinearTrain(FREE).mesh_tau[0]
    },
)


@pytest.fixture(scope="module")
def train():
    return LinearTrain(SCENE)


def fastest(train):
    """Spectral radius [1/s]."""
    return np.abs(np.linalg.eigvals(train.system())).max()


def relative_error(found, exact):
    with np.errstate(over="ignore", invalid="ignore"):
        return np.sqrt(((found - exact) ** 2).mean() / (exact**2).mean())


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4, 1e-5])
def test_the_twin_passes_the_same_step_within_its_tolerance(train, tolerance):
    twin = pt.Twin(SCENE, tolerance=tolerance)
    rest = twin.advance(1e-3).waveform.dte[-1]
    begin = twin.set(input_torque=BEFORE + STEP)
    wave = twin.advance(SPAN).waveform
    exact = train.after_step(STEP, wave.time - begin)
    whole = (BEFORE + STEP) / STEP  # the tolerance refers to all of the deflection
    assert relative_error(wave.dte - rest, exact) < 3.0 * tolerance * whole


def test_twin_takes_steps_far_beyond_limit_of_explicit_methods():
    """At 10 rpm with the damping of the scene `paper`, tau = 0.009/5 Hz."""
    law = {"mesh.damping.law": "meshing_frequency"}
    scene = SCENE.replace(input_speed=pt.rpm(10), **law)
    run = pt.simulate(scene, 0.2, 1e4, tolerance=1e-3)
    slow = LinearTrain(scene)
    slow.mesh_tau[:] = scene.mesh.damping.loss_factor / scene.mesh.damping.lowest_frequency
    assert 0.2 / run.stats.steps > 100.0 * 2.785 / fastest(slow)
