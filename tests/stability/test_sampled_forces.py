"""What is sampled between steps is as right as the steps: mesh forces of long, stiff steps."""

import numpy as np
import pytest
from stability.sound import PAPER

import planetary_twin_py as pt

STIFF = {"mesh.sun_planet_stiffness": 1e13, "mesh.planet_ring_stiffness": 1e13}
UNEQUAL = {  # the soft teeth yield by more than a millimetre
    "mesh.sun_planet_stiffness": 1e11,
    "mesh.planet_ring_stiffness": 1e5,
    "input_torque": 5.0,
}
OVERDAMPED = {
    "input_speed": 0.1,
    "mesh.damping.loss_factor": 1.0,
    "mesh.damping.lowest_frequency": 1e-4,
}


def relative_error(changes, tolerance):
    """Of the mesh forces (rms), against a tight tolerance."""
    scene = PAPER.replace(**changes)
    found, exact = (pt.simulate(scene, 0.01, 20_000.0, tolerance=t) for t in (tolerance, 1e-8))
    gap = np.sqrt(((found.mesh_force - exact.mesh_force) ** 2).mean(axis=0))
    return (gap / np.sqrt((exact.mesh_force**2).mean(axis=0))).max()


@pytest.mark.parametrize(
    "changes",
    [{}, {"input_speed": 1.0}, STIFF, UNEQUAL, OVERDAMPED],
    ids=["paper", "slow", "stiff", "unequal", "overdamped"],
)
def test_mesh_forces_are_right_within_a_few_per_cent(changes):
    assert relative_error(changes, 1e-4) < 0.05


@pytest.mark.parametrize("tolerance", [1e-3, 1e-4, 1e-5])
def test_overdamped_mesh_forces_keep_tolerance_between_steps_too(tolerance):
    assert relative_error(OVERDAMPED, tolerance) < tolerance
