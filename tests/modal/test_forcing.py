"""Strength of resonances: harmonics of the meshes on the modes, beside runs at many speeds."""

import cmath
import math

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.modal.campbell import resonances
from planetary_twin_py.modal.forcing import equivalent_error, forcing
from planetary_twin_py.modal.natural import spring_model
from planetary_twin_py.units.catalogue import SIDES

RPM = 30.0 / math.pi
# Equal planets, all in phase, whose mesh stiffness varies little: vibration is nearly linear.
QUIET = pt.load_scene("paper").replace(
    **{
        "gearset.teeth": {"sun": 30, "planet": 21, "ring": 72},
        "gearset.planet_angles": [0.0, 2.0 * math.pi / 3.0, 4.0 * math.pi / 3.0],
        "mesh.double_pair_ratio": 1.2,
        "mesh.damping": {"law": "viscous", "damping_ratio": 0.01},
        "lubrication.friction": False,
    }
)


def crossings(scene, lowest, highest):
    modes, springs = (make(scene, "machines", "mean") for make in (pt.natural_modes, spring_model))
    found = resonances(scene, modes, springs, pt.rpm(highest))
    return [r for r in found if r.speed >= pt.rpm(lowest)]


@pytest.mark.slow
def test_strongest_crossings_are_peaks_of_the_vibration_of_runs():
    speeds = np.arange(1250.0, 2500.0, 12.5)
    runs = pt.simulate_many(
        (QUIET.replace(input_speed=pt.rpm(s)) for s in speeds), 0.05, tolerance=1e-3
    )
    dte = np.array([run.result.dte[-1500:].std(axis=0).max() for run in runs])
    inner = dte[1:-1]
    peaks = (inner > dte[:-2]) & (inner > dte[2:]) & (inner > 1.4 * np.median(dte))
    found = [r for r in crossings(QUIET, speeds[0], speeds[-1]) if r.weight > 0.0]
    at = np.array([r.speed * RPM for r in found])
    for peak in speeds[1:-1][peaks]:
        assert np.abs(at / peak - 1.0).min() < 0.007, peak
    strongest = max(found, key=lambda r: r.weight)
    assert strongest.harmonic == 7  # which a list of five harmonics does not have
    assert speeds[dte.argmax()] == pytest.approx(strongest.speed * RPM, rel=0.007)


def test_modes_that_the_phases_cancel_have_no_weight():
    found = crossings(QUIET, 100.0, 10_000.0)
    weights = {kind: {r.weight > 0.0 for r in found if r.kind == kind} for kind in ("planet",)}
    assert weights == {"planet": {False}}
    assert all(r.weight > 0.0 for r in found if r.kind == "rotational" and r.harmonic > 5)


def test_harmonics_of_a_step_are_those_of_a_rectangular_wave():
    """k = 1.2 for the fraction eps - 1 of the cycle and 1 otherwise: |k_h| = 0.4 |sin(..)|/pi h."""
    scene = QUIET.replace(**{"mesh.ramp": 0.0})
    springs, mesh = spring_model(scene, "torsional", "mean"), scene.gearset.geometry.meshes[0]
    double = mesh.path.contact_ratio - 1.0
    mean, single = 1.0 + 0.2 * double, scene.mesh.sun_planet_stiffness
    force = scene.operating_point.input_torque / (3.0 * scene.gearset.geometry.sun.base_radius)
    meshes = [s for s in springs.springs if s.kind == SIDES[0]]
    found = np.abs(equivalent_error(scene, 0, meshes, 8))
    for h, amplitude in enumerate(found, 1):
        wave = 0.4 * abs(math.sin(math.pi * h * double)) / (math.pi * h)
        expected = wave / mean * force / (mean * single)
        assert amplitude == pytest.approx(expected, rel=1e-2, abs=1e-3 * found.max())


def test_an_error_of_form_pulls_with_the_stiffness_of_the_mesh():
    errors = {"mesh.sun_planet_error": {"amplitudes": [0.0, 2e-6], "phases": [0.0, 0.5]}}
    scene = QUIET.replace(**errors, **{"mesh.double_pair_ratio": 1.0})
    springs = spring_model(scene, "torsional", "mean")
    pull = forcing(scene, springs, 4).pull
    stiffness = next(s.stiffness for s in springs.springs if s.kind == SIDES[0])
    # 2e-6 sin(angle + 0.5), in the clock's sense of exp(-i w t)
    expected = 2e-6 * stiffness * cmath.exp(-1j * (0.5 - math.pi / 2.0))
    assert pull[1, :3] == pytest.approx([expected] * 3)
    assert not pull[[0, 2, 3]].any() and not pull[:, 3:].any()


def test_shafts_turn_and_planets_pass_at_orders_of_the_diagram():
    from planetary_twin_py.modal.campbell import shaft_orders

    scene = pt.load_scene("wind_turbine_stage")  # the carrier drives the sun
    teeth, speed = scene.gearset.teeth, np.array(pt.rpm(60.0))
    found = {name: float(line.at(speed)) for name, line in shaft_orders(scene).items()}
    assert found == pytest.approx(
        {
            "turn of the input shaft": 1.0,
            "turn of the output shaft": 1.0 + teeth.ring / teeth.sun,
            "planet that passes": float(scene.gearset.planets),
        }
    )
