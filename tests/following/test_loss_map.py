"""The table of losses against runs between its points."""

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


def test_its_slope_is_its_derivative():
    losses = loss_map(paper())
    for torque in (20.0, 50.0):
        step = 1e-4 * torque
        above, below = (losses(torque + sign * step, 100.0, 343.15).teeth for sign in (1, -1))
        slope = (above - below) / (2.0 * step)
        assert losses(torque, 100.0, 343.15).slope == pytest.approx(slope, rel=1e-5)


def test_faults_and_runouts_of_the_scene_are_left_out():
    scene = pt.load_scene("cracked_tooth")
    healthy = scene.replace(faults=())
    at = 50.0, 100.0, 343.15
    assert loss_map(scene)(*at) == loss_map(healthy)(*at)
