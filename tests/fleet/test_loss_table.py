"""The table of a fleet against the scalar table and against runs between its points."""

import numpy as np
import pytest
from fleet.fleets import paper

from planetary_twin_py.fleet.loss_table import loss_table
from planetary_twin_py.following.loss_map import loss_map


def test_it_interpolates_as_the_scalar_table():
    scene = paper(**{"losses.planet_bearing": {"mean_diameter": 0.012}})
    chance = np.random.default_rng(1)
    torque = chance.uniform(-110.0, 110.0, 40)
    speed = chance.uniform(-160.0, 160.0, 40)
    oil = chance.uniform(310.0, 380.0, 40)
    found, scalar = loss_table(scene)(torque, speed, oil), loss_map(scene)
    for n in range(40):
        loss = scalar(torque[n], speed[n], oil[n])
        assert found.teeth[n] == pytest.approx(loss.teeth, rel=1e-12)
        assert found.rest[n] == pytest.approx(loss.rest, rel=1e-12)


def test_its_error_bound_holds_at_other_points():
    scene, chance = paper(), np.random.default_rng(99)
    table, losses = loss_table(scene), loss_map(scene)
    for _ in range(10):
        at = chance.uniform(2.0, 90.0), chance.uniform(5.0, 150.0), chance.uniform(325.0, 360.0)
        teeth, rest = table(*(np.array([value]) for value in at))
        assert float(teeth[0] + rest[0]) == pytest.approx(sum(losses.run(*at)), rel=table.error)
    assert table.error < 0.03
