"""Passages that follow from the turns of a real gearbox are those that the core counts."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.durability.passages import passages_per_turn, whole_passages
from planetary_twin_py.following.train import followed_train

CYCLES = 40


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("name", ["paper", "compact_actuator", "helical_stage"])
def test_passages_of_turns_are_those_of_a_run(name, sign):
    scene = pt.load_scene(name).replace(durability={}, dynamics="quasi_static")
    scene = scene.replace(input_torque=sign * abs(scene.operating_point.input_torque))
    train = followed_train(scene)
    turns = CYCLES / abs(float(train.cycles))
    duration = turns * 2.0 * math.pi / abs(scene.operating_point.input_speed)
    run = pt.simulate(scene, duration, 10.0 / duration).damage
    of_torque = np.array([turns, 0.0] if sign > 0 else [0.0, turns])
    found = whole_passages(passages_per_turn(scene, train.cycles), of_torque)
    assert run.passages.max() == 3 * CYCLES
    # Turns are no whole number of cycles to the last digit, and a root counts two meshes.
    assert np.abs(found - run.passages).max() <= 2
    assert ((found == 0) == (run.passages == 0)).all()
