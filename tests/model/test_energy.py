"""The energy ledger: what the motor puts in is what comes out, is stored, and is lost."""

import math
from itertools import pairwise

import pytest
from power_flows import ALL_FLOWS, FLOWS, scene_of

from planetary_twin_py import load_scene, packaged_scenes, simulate

SCENES = pytest.mark.parametrize("name", packaged_scenes())
RATTLE = {"input_torque": 0.3, "torque_ripple": 3.0}


def imbalance(scene, tolerance, method="auto"):
    energy = simulate(scene, 0.05, tolerance=tolerance, method=method).energy
    driven = scene.lubrication.friction_torque == "printed"  # by a sign that puts energy in
    assert energy.friction < 0.0 if driven else energy.friction > 0.0
    assert energy.damping > 0.0 or scene.dynamics == "quasi_static"
    return abs(energy.residual) / energy.driving_work


@SCENES
def test_balance_closes_in_every_packaged_scene(name):
    assert imbalance(load_scene(name), 1e-5) < 1e-6


def assert_balanced(scene):
    coarse, fine = imbalance(scene, 1e-4), imbalance(scene, 1e-5)
    assert coarse < 1e-5
    assert fine < 1e-6


@ALL_FLOWS
@pytest.mark.parametrize("law", ["meshing_frequency", "viscous"])
def test_balance_closes_whatever_is_held_and_driven(flow, law):
    assert_balanced(scene_of(flow, **{"mesh.damping.law": law}))


@pytest.mark.parametrize("law", ["meshing_frequency", "viscous"])
def test_balance_closes_while_teeth_rattle(law):
    scene = scene_of(FLOWS[0], **RATTLE, **{"mesh.damping.law": law})
    assert simulate(scene, 0.05).stats.flank_events > 20
    assert_balanced(scene)


@pytest.mark.parametrize("planets", [2, 4, 5, 6])
def test_balance_closes_for_any_number_of_planets(planets):
    step = 2 * math.pi / 100
    angles = tuple(step * round(100 * k / planets) for k in range(planets))
    assert_balanced(scene_of(FLOWS[0], **{"gearset.planet_angles": angles}))


@pytest.mark.parametrize(
    "changes",
    [
        {"mesh.ramp": 0.0},
        {"input_speed": -100.0},
        {"input_torque": -63.0},
        {"lubrication.lambda_ratio": "computed", "lubrication.film": "dowson_toyoda"},
    ],
    ids=str,
)
def test_balance_closes_for_steps_of_the_stiffness(changes):
    assert_balanced(scene_of(FLOWS[0], **changes))


def test_residual_falls_with_the_tolerance():
    tolerances, scene = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6), scene_of(FLOWS[0])
    residuals = [imbalance(scene, tolerance, "rosenbrock") for tolerance in tolerances]
    assert all(b < 0.5 * a for a, b in pairwise(residuals))
    assert residuals[-1] < 1e-7


def test_residual_of_collocation_falls_with_the_tolerance():
    """It passes through zero on the way."""
    for tolerance, bound in ((1e-2, 1e-4), (1e-4, 1e-6), (1e-6, 1e-7)):
        assert imbalance(scene_of(FLOWS[0]), tolerance) < bound


@pytest.mark.parametrize(
    "changes",
    [
        {"mesh.sun_planet_error": {"amplitudes": ["3 um", "1 um"], "phases": [0.3, 2.0]}},
        {"mesh.planet_ring_error": {"amplitudes": ["12 um"]}, "input_torque": -40.0},
        {"mesh.runout": {"sun": "20 um", "planet": "10 um", "ring": "15 um"}, "backlash": "22 um"},
        {"faults": [{"kind": "crack", "gear": "planet", "planet": 2, "stiffness_loss": 0.5}]},
        {"faults": [{"kind": "spall", "gear": "ring", "tooth": 1, "stiffness_loss": 0.4}]},
        {"faults": [{"kind": "wear", "gear": "sun", "tooth": 1, "depth": "2 um"}]},
        {"mesh.stiffness": "involute"},
        {
            "mesh.stiffness": "involute",
            "faults": [{"kind": "crack", "gear": "sun", "depth": "0.5 mm"}],
        },
        {"mesh.backlash": "regulatory_factor"},
        {"mesh.damping.law": "natural_frequency"},
        {"errors.planet_stiffness": (0.7, 1.0, 1.3)},
    ],
    ids=lambda changes: "-".join(changes),
)
def test_balance_closes_with_every_error_and_fault_of_the_teeth(changes):
    assert imbalance(scene_of(FLOWS[0], **changes), 1e-5) < 1e-6
