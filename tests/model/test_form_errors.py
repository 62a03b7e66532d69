"""Errors of form: the train follows them as statics says, and they come at their orders."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt

ZS, ZP, ZR = 30, 20, 70
SLOW = 5.0  # [Hz] meshing frequency
# A constant stiffness leaves the errors as the only excitation.
STEADY = pt.load_scene("paper").replace(
    **{
        "lubrication.friction": False,
        "mesh.double_pair_ratio": 1.0,
        "mesh.damping.law": "viscous",
        "input_speed": 2 * math.pi * SLOW / ZS,
    }
)


def lines(signal, cycles, orders):
    """Amplitudes of `signal`, which spans whole mesh cycles, at orders of the mesh frequency."""
    phase = 2 * math.pi * np.outer(orders, np.linspace(0.0, cycles, len(signal), endpoint=False))
    signal = signal - signal.mean()
    return 2 * np.hypot(np.cos(phase) @ signal, np.sin(phase) @ signal) / len(signal)


def test_without_errors_at_constant_stiffness_nothing_moves():
    run = pt.simulate(STEADY, 0.1)
    assert run.dte.std(axis=0).max() < 1e-4 * run.dte.mean()


def test_a_slow_train_in_phase_takes_the_error_up_without_force():
    """All sun meshes at once by the same e: nothing resists, d = F/k + b + e."""
    scene = STEADY.replace(
        **{
            "gearset.planet_angles": tuple(2 * math.pi * k / 5 for k in range(5)),  # in phase
            "mesh.sun_planet_error": {"amplitudes": ["4 um", "1 um"], "phases": [0.4, 1.0]},
            "drive.output.coupling_stiffness": 1e5,
        }
    )
    run = pt.simulate(scene, 5 / SLOW, 500 * SLOW, tolerance=1e-5)
    found = lines(run.dte[500:, 0], 4, [1, 2, 3])
    assert found == pytest.approx([4e-6, 1e-6, 0.0], rel=0.02, abs=2e-8)
    assert run.mesh_force[500:, 0].std() < 5e-3 * run.mesh_force[:, 0].mean()


@pytest.mark.parametrize(
    "gear, teeth, mesh", [("sun", ZS, 0), ("planet", ZP, 1), ("planet", ZP, 3), ("ring", ZR, 4)]
)
def test_runout_returns_with_every_turn_of_its_gear(gear, teeth, mesh):
    size = 2e-6  # [m] 10 um of a planet, in both of its meshes, would part them
    scene = STEADY.replace(**{"mesh.runout": {gear: size}}, backlash="2 um")
    cycles = 2 * teeth
    run = pt.simulate(scene, (cycles + 10) / SLOW, 20 * SLOW, tolerance=1e-4)
    signal = run.dte[-20 * cycles :, mesh]
    orders = np.array([1 / teeth, 1.5 / teeth, 3 / teeth, 1.0])
    found = lines(signal, cycles, orders)
    assert found[0] > 0.1 * size
    assert found[1:].max() < 0.05 * found[0]


def test_planets_differ_as_their_mesh_phases_do():
    """Statics: d_i = e_i/2 + mean(e)/2, so d_i - d_j has the amplitude a sin(pi |g_i - g_j|)."""
    scene = STEADY.replace(**{"mesh.sun_planet_error": {"amplitudes": ["2 um"]}})
    run = pt.simulate(scene, 5 / SLOW, 500 * SLOW, tolerance=1e-5)
    d = run.dte[500:, :3]
    for first, second, phase in ((0, 1, 0.1), (0, 2, 0.1), (1, 2, 0.2)):
        found = lines(d[:, first] - d[:, second], 4, [1])
        assert found == pytest.approx(2e-6 * math.sin(math.pi * phase), rel=0.02)
