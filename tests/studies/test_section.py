"""The section shows meshes at one phase: a point for periodic motion, a closed form if linear."""

import math

import numpy as np
import pytest
from stability.linear_train import LinearTrain
from stability.sound import PLAIN, static_force

import planetary_twin_py as pt
from planetary_twin_py.studies.section import Section

AMPLITUDE = 3e-7  # [m] bends teeth less than the load does: flanks stay in contact
LINEAR = PLAIN.replace(**{"mesh.sun_planet_error": {"amplitudes": [AMPLITUDE]}})
SPEED = pt.rpm(4000)


def closed_form(scene, cycle):
    """DTE of every mesh at a mesh phase (0 to 1), from the frequency response of the train."""
    train, teeth, planets = LinearTrain(scene), scene.gearset.teeth, scene.gearset.planets
    omega = scene.operating_point.input_speed * teeth.sun
    stiffness, damping = train.matrices()
    dynamic = stiffness - omega**2 * np.diag(train.inertia) + 1j * omega * damping
    angles = np.array(scene.gearset.planet_angles)
    phase = teeth.sun * (angles - angles[0]) / (2.0 * math.pi)
    error = np.zeros(2 * planets, complex)
    error[:planets] = AMPLITUDE * np.exp(-2j * math.pi * phase)
    yielding = train.mesh_stiffness * (1.0 + 1j * omega * train.mesh_tau)
    motion = train.rows @ np.linalg.solve(dynamic, train.rows.T @ (yielding * error))
    mean = static_force(scene) / train.mesh_stiffness + 0.5 * scene.operating_point.backlash
    return mean + (motion * np.exp(2j * math.pi * cycle)).imag


def settled(scene, phase, settling=1.0):
    section = Section(scene, 1e-6, phase)
    section.hold(scene.operating_point.input_speed, settling)
    return np.array([section.dte() for _ in range(20)])


@pytest.mark.parametrize("phase", [0.0, 0.3])
def test_a_linear_train_has_its_frequency_response(phase):
    scene = LINEAR.replace(input_speed=SPEED)
    seen, expected = settled(scene, phase), closed_form(scene, phase)
    swing = np.ptp([closed_form(scene, cycle) for cycle in np.linspace(0.0, 1.0, 100)], axis=0)
    assert seen.mean(axis=0) == pytest.approx(expected, abs=2e-3 * swing.min())
    assert np.ptp(seen, axis=0).max() < 1e-3 * swing.min()


def test_a_section_needs_the_torsional_model():
    with pytest.raises(ValueError, match="dynamics = 'quasi_static': must be torsional"):
        Section(PLAIN.replace(dynamics="quasi_static"), 1e-4)
