"""No load, a load that changes its sign, and loads that jump by a factor of a hundred."""

import numpy as np
import pytest
from stability.sound import PAPER, PLAIN, UNIFORM, sound_run, static_force, stiffnesses

import planetary_twin_py as pt

# Shafts that settle within a few hundredths of a second.
DAMPED = {"drive.input.coupling_damping": 3.0, "drive.output.coupling_damping": 16.0}
FREE = {"drive.speed_control.bandwidth": 1e-6}  # nothing but the torque drives
LIGHT, HEAVY = 0.63, 63.0  # [N m]


def settled_after(scene, torque, duration=0.3):
    """The last tenth of what follows a change of the torque."""
    twin = pt.Twin(scene, tolerance=1e-6)
    twin.advance(0.01)
    twin.set(input_torque=torque)
    waves = [twin.advance(0.1 * duration).waveform for _ in range(10)]
    for wave in waves:
        assert np.isfinite(wave.dte).all() and np.isfinite(wave.mesh_force).all()
    return waves[-1]


def assert_carries(wave, scene, torque):
    force = static_force(scene.replace(input_torque=torque))
    half = np.copysign(0.5 * scene.operating_point.backlash, force)
    assert wave.mesh_force == pytest.approx(np.full(wave.mesh_force.shape, force), rel=1e-3)
    expected = force / stiffnesses(scene) + half
    assert wave.dte == pytest.approx(np.tile(expected, (len(wave.dte), 1)), rel=1e-3)


@pytest.mark.parametrize("law", ["viscous", "meshing_frequency"])
def test_without_load_there_is_neither_force_nor_friction(law):
    idle = sound_run(PAPER.replace(input_torque=0.0, **{"mesh.damping.law": law}), 0.05)
    loaded = sound_run(PAPER.replace(**{"mesh.damping.law": law}), 0.05, tolerance=1e-4)
    assert idle.energy.friction < 1e-6 * loaded.energy.friction
    assert np.abs(idle.mesh_force).max() < 1e-2  # of the 1 N the tolerance refers to
    assert np.abs(idle.dte).max() <= 0.5 * PAPER.operating_point.backlash * (1.0 + 1e-4)
    assert idle.speed[-1, 0] == pytest.approx(pt.rpm(1000), rel=1e-6)


@pytest.mark.parametrize("torque", [HEAVY, -HEAVY])
def test_a_load_that_changes_its_sign_ends_on_the_other_flanks(torque):
    scene = PLAIN.replace(input_torque=torque, **DAMPED)
    assert_carries(settled_after(scene, -torque), scene, -torque)


def test_the_other_flanks_carry_the_same_except_for_friction():
    wave = settled_after(UNIFORM.replace(**DAMPED), -HEAVY)
    assert wave.mesh_force.mean(axis=0) == pytest.approx(-static_force(UNIFORM), rel=0.02)


@pytest.mark.parametrize("torque", [LIGHT, -LIGHT])
def test_hundredth_of_load_at_once_has_the_teeth_part_and_settle(torque):
    scene = PLAIN.replace(**DAMPED, **FREE)
    assert_carries(settled_after(scene, torque), scene, torque)
