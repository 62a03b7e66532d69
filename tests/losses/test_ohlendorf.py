"""Ohlendorf's loss factor against integration over the path, and against the running gearbox."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.gearset.geometry import planet_ring_path, sun_planet_path
from planetary_twin_py.gearset.kinematics import Teeth
from planetary_twin_py.losses.ohlendorf import tooth_loss_factor

PAPER = Teeth(30, 20, 70), math.radians(21.34), 1.0
SUN = sun_planet_path(*PAPER), 30, 20, False
RING = planet_ring_path(*PAPER), 20, 70, True
BOTH = pytest.mark.parametrize("mesh", [SUN, RING], ids=["sun_planet", "planet_ring"])


def integrated(path, first, second, internal):
    """Mean over a mesh cycle of |sliding|/rolling, the load shared equally by the pairs there."""
    total = 0.0
    cycles = (np.arange(20_000) + 0.5) / 20_000
    for x in cycles:
        s = x + np.arange(-2, 3)
        s = s[(s > -path.approach) & (s < path.recess)]
        total += np.abs(s).mean()
    # A base pitch of slip is 2 pi/z radians on each gear's base circle.
    return 2 * math.pi * (1 / first + (-1 if internal else 1) / second) * total / len(cycles)


@BOTH
def test_closed_form_is_the_integral_over_the_path(mesh):
    # At the ring teeth approach over more than a base pitch, which the closed form does not know.
    closed = mesh[0].approach < 1.0
    assert tooth_loss_factor(*mesh) == pytest.approx(
        integrated(*mesh), rel=5e-4 if closed else 4e-3
    )


@pytest.mark.parametrize("mesh, expected", [(SUN, 0.17152), (RING, 0.09778)])
def test_loss_factors_of_the_papers_gearset(mesh, expected):
    assert tooth_loss_factor(*mesh) == pytest.approx(expected, abs=1e-5)


@pytest.mark.parametrize("kind, mesh, published", [(0, SUN, 0.9925), (1, RING, 0.9958)])
def test_mesh_efficiency_of_a_run_is_that_of_ohlendorf_with_its_own_friction(kind, mesh, published):
    """mu from friction over force, both means. The dynamic load is shared by stiffness, not
    equally, and friction sinks around the pitch point: within 4 % of the loss."""
    run = pt.simulate(pt.load_scene("paper"), 0.1)
    meshes = slice(3) if kind == 0 else slice(3, 6)
    friction = run.boundary_friction + run.viscous_friction
    mu = friction[:, meshes].sum() / np.abs(run.mesh_force[:, meshes]).sum()
    loss = 1.0 - run.mesh_efficiency[kind]
    assert loss == pytest.approx(mu * tooth_loss_factor(*mesh), rel=0.04)
    assert run.mesh_efficiency[kind] == pytest.approx(published, abs=2e-4)
