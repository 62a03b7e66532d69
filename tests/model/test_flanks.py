"""Drive and coast flanks: where in the cycle one pair is alone, and which way it pushes."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt

TEETH = 30
PHASES = np.array([0.0, 0.1, 0.9, 0.5, 0.6, 0.4])
CALM = pt.load_scene("paper").replace(
    **{
        "lubrication.friction": False,
        "mesh.ramp": 0.0,
        "mesh.damping.law": "viscous",
        "mesh.damping.damping_ratio": 1.0,
        "input_speed": 2.0,
    }
)
# Single-pair window of the drive side, in cycles after the pitch point of the pair (approach is
# made by the tip of the driven gear).
SINGLE = {0: (-0.2008, 0.2438), 3: (-0.2438, -0.0531)}


def single_window(scene, mesh):
    """Cycles, from the pitch point of the drive side on, at which the mesh has one pair."""
    run = pt.simulate(scene, 0.3, 50_000.0)
    stiffness = np.abs(run.mesh_force[:, mesh]) / (np.abs(run.dte[:, mesh]) - 1e-7)
    assert np.quantile(stiffness, [0.05, 0.95]) == pytest.approx([2e8, 3.5e8], rel=1e-3)
    cycle = TEETH * run.angle[:, 0] / (2 * math.pi) - PHASES[mesh]
    alone = (cycle[stiffness < 2.75e8] + 0.5) % 1.0 - 0.5
    return alone


def assert_is(found, window):
    middle, half = np.mean(window), 0.5 * (window[1] - window[0])
    distance = np.abs((found - middle + 0.5) % 1.0 - 0.5)
    assert distance.max() == pytest.approx(half, abs=2e-3)


@pytest.mark.parametrize("mesh", [0, 3])
def test_one_pair_is_alone_where_the_paths_of_contact_say(mesh):
    assert_is(single_window(CALM, mesh), SINGLE[mesh])


@pytest.mark.parametrize("mesh", [0, 3])
def test_on_coast_flanks_window_is_mirrored_half_a_pitch_later(mesh):
    """Seen from a coast pair the motion runs backwards: x -> 1/2 - x."""
    low, high = SINGLE[mesh]
    assert_is(single_window(CALM.replace(input_torque=-63.0), mesh), (0.5 - high, 0.5 - low))


@pytest.mark.parametrize("mesh", [0, 3])
def test_turning_back_meets_the_same_flanks_in_the_same_places(mesh):
    assert_is(single_window(CALM.replace(input_speed=-2.0), mesh), SINGLE[mesh])
