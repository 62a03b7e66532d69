"""The table of losses against runs between its points."""

import numpy as np
import pytest
from following.plants import LAWS, paper

import planetary_twin_py as pt
from planetary_twin_py.following.loss_map import loss_map


@pytest.mark.parametrize(
    ("torque", "speed", "oil"), [(63.0, 104.7, 343.15), (40.0, 80.0, 350.0), (-25.0, 130.0, 335.0),
                                 (12.0, -50.0, 343.15), (-80.0, -20.0, 343.15)]
)  # fmt: skip
def test_it_is_the_loss_of_a_quasi_static_run_to_a_percent(torque, speed, oil):
    scene = paper().replace(**LAWS["with bearings"])
    there = scene.replace(
        dynamics="quasi_static", input_torque=torque, input_speed=speed, oil_temperature=oil
    )
    run = pt.simulate(there, 0.2)
    turned = run.duration * abs(speed)
    found = loss_map(scene)(torque, speed, oil)
    assert found.teeth == pytest.approx(run.energy.friction / turned, rel=0.015)
    assert found.rest == pytest.approx(run.energy.bearing / turned, rel=0.015)


def test_points_together_are_the_points_alone():
    losses, chance = loss_map(paper()), np.random.default_rng(1)
    points = [chance.uniform(*ends, 40) for ends in ((-110, 110), (-160, 160), (310, 380))]
    alone = [losses(*point) for point in zip(*points, strict=True)]
    assert np.array_equal(losses(*points), np.transpose(alone))


def test_its_error_bound_holds_at_other_points():
    losses, chance = loss_map(paper()), np.random.default_rng(99)
    for _ in range(10):
        at = chance.uniform(2.0, 90.0), chance.uniform(5.0, 150.0), chance.uniform(325.0, 360.0)
        assert losses(*at).total == pytest.approx(sum(losses.run(*at)), rel=losses.error)
    assert losses.error < 0.03


def test_faults_and_runouts_of_the_scene_are_left_out():
    scene = pt.load_scene("cracked_tooth")
    healthy = scene.replace(faults=())
    at = 50.0, 100.0, 343.15
    assert loss_map(scene)(*at) == loss_map(healthy)(*at)
