"""Ratios, inertia and hunting period against the model."""

import numpy as np
import pytest
from following.plants import paper

import planetary_twin_py as pt
from planetary_twin_py.following.train import followed_train


@pytest.mark.parametrize("name", ["paper", "wind_turbine_stage", "reference_gearbox_stage"])
def test_inertia_is_that_of_the_kinetic_energy(name):
    scene = pt.load_scene(name).replace(dynamics="quasi_static")
    run = pt.simulate(scene, 0.01)
    speed = scene.operating_point.input_speed
    assert followed_train(scene).inertia == pytest.approx(
        2.0 * run.energy.stored / speed**2, rel=1e-6
    )


def test_ratio_and_mesh_cycles_are_those_of_a_run():
    train, run = followed_train(paper()), pt.simulate(paper(), 0.1)
    sun, ring = (run.mean_speed[run.bodies.index(body)] for body in ("sun", "ring"))
    assert train.ratio == pytest.approx(ring / sun, rel=1e-5)
    assert train.cycles == 30 and train.hunting_cycles == 420


def test_torques_of_the_twin_balance_with_these_signs():
    train = followed_train(paper())
    window = pt.Twin(paper()).advance(0.1)
    lost = window.power_loss / window.input_speed
    balance = window.input_torque + train.ratio * window.output_torque
    assert balance == pytest.approx(lost, rel=0.05)
    assert np.sign(balance) == 1.0


def test_a_differential_is_refused():
    with pytest.raises(pt.SceneError, match=r"^drive\.second_input: a differential cannot"):
        followed_train(pt.load_scene("differential"))
