"""Mean forces: torques are as the teeth, whatever is held."""

import math

import pytest
from power_flows import ALL_FLOWS, scene_of

from planetary_twin_py import simulate
from planetary_twin_py.units.conversion import rpm

FORCE = 63.0 / 3 / (0.012 * math.cos(math.radians(21.34)))  # 1878.8 N


@ALL_FLOWS
def test_every_mesh_carries_1879_newtons_without_friction(flow):
    """Of 63 N m at the sun, 147 N m at the ring, -210 N m at the carrier, any two give it."""
    scene = scene_of(flow, **{"lubrication.friction": False, "input_speed": rpm(1000)})
    result = simulate(scene, 0.1)
    mean = result.mesh_force[result.time > 0.02].mean(axis=0)
    assert pytest.approx(1878.8, abs=0.1) == FORCE
    assert mean.mean() == pytest.approx(FORCE, rel=2e-4)
    assert mean == pytest.approx(FORCE, rel=0.02)  # planets share unequally, by their phases
    assert mean[:3] == pytest.approx(mean[3:], rel=1e-3)  # a planet's torques cancel
