"""Where methods off the shelf fail on the teeth of the scene `paper`, and the twin does not.

The model they are given is self-written and has an exact solution; its damping is that of the
scene at 1000 rpm, tau = 0.009/f_m.
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


def fixed_steps(train, method, count):
    """d of all meshes after a step of the torque, at `count` equal steps."""
    y, h, n = np.zeros(2 * train.bodies), SPAN / count, train.bodies
    a, b = train.system(), train.push(STEP)
    result = []
    with np.errstate(over="ignore", invalid="ignore"):
        for _ in range(count):
            y = method(a, b, y, h)
            result.append(train.rows @ y[:n])
    return np.array(result), h * np.arange(1, count + 1)


def rk4(a, b, y, h):
    k1 = a @ y + b
    k2 = a @ (y + 0.5 * h * k1) + b
    k3 = a @ (y + 0.5 * h * k2) + b
    k4 = a @ (y + h * k3) + b
    return y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)


def semi_implicit_euler(a, b, y, h):
    """Speeds by the forces at the old place, places by the new speeds."""
    n = len(y) // 2
    new = y + h * (a @ y + b)
    new[:n] = y[:n] + h * new[n:]
    return new


def error_of(train, method, h):
    found, times = fixed_steps(train, method, round(SPAN / h))
    return relative_error(found, train.after_step(STEP, times))


# Real negative eigenvalues: |1 + z + z^2/2 + z^3/6 + z^4/24| < 1 down to z = -2.785.
@pytest.mark.parametrize("method, limit", [(rk4, 2.785), (semi_implicit_euler, 2.0)])
def test_an_explicit_method_blows_up_beyond_its_stability_limit(train, method, limit):
    longest = limit / fastest(train)
    assert error_of(train, method, 0.5 * longest) < 0.3
    assert not error_of(train, method, 1.3 * longest) < 1e3


def test_semi_implicit_euler_is_wrong_before_it_blows_up(train):
    """First order: what is stable is not yet right."""
    longest = 2.0 / fastest(train)
    coarse, fine = (error_of(train, semi_implicit_euler, x * longest) for x in (0.7, 0.07))
    assert coarse > 0.05
    assert fine < 0.2 * coarse


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
