"""Mean forces: torques are as the teeth, whatever is held."""

import math

import numpy as np
import pytest
from power_flows import ALL_FLOWS, scene_of

from planetary_twin_py import simulate
from planetary_twin_py.run.engine import Engine
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


@ALL_FLOWS
def test_a_run_begins_in_balance(flow):
    """Every mesh starts with its share, so that no body is far from rest in the rigid train."""
    engine = Engine(scene_of(flow, **{"lubrication.friction": False}), 1e-4)
    force = engine.sample(0.0).mesh[0, 1]
    assert force.sum() == pytest.approx(6 * FORCE, rel=0.02)
    assert np.all(np.abs(force / FORCE - 1.0) < 0.5)
