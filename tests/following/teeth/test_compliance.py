"""Changes of compliance and backlash from mean transmission errors of the model."""

from functools import cache

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.following.balance.variety import TORQUES
from planetary_twin_py.following.teeth.compliance import Compliance
from planetary_twin_py.following.transmission_error import model_error

LEARNING, LATER, NOISE = 24, 32, 5e-9  # blocks, blocks, [m]
PLAY, SOFTER = 0.5e-6, 0.01  # [m], change of the stiffness
LOADS = -100.0, -30.0, 30.0, 100.0  # [N m]
SCENE = pt.load_scene("paper")
CHANGES = {
    "none": {},
    "play": {"backlash": 0.2e-6 + PLAY},
    "stiffness": {
        f"mesh.{name}_stiffness": (1.0 - SOFTER) * getattr(SCENE.mesh, f"{name}_stiffness")
        for name in ("sun_planet", "planet_ring")
    },
}


@cache
def mean_errors(change):
    """Mean transmission errors of the model at `LOADS` [m]."""
    scenes = (SCENE.replace(input_torque=load, **CHANGES[change]) for load in LOADS)
    return [float(np.mean(model_error(scene, 4, 40, 0.1, 1e-6)[1])) for scene in scenes]


def followed(change, seed, reverses=False, wander=0.02, at=LEARNING + 1):
    """Changes found in blocks of a wandering load, of which one has the step within."""
    chance = np.random.default_rng(seed)
    found = Compliance(LEARNING)
    for n in range(LEARNING + LATER):
        side = -1.0 if reverses and n % 6 < 3 else 1.0
        torque = side * 63.0 * (1.0 + wander * chance.standard_normal())
        before, after = (np.interp(torque, LOADS, mean_errors(one)) for one in ("none", change))
        error = before if n < at else 0.5 * (before + after) if n == at else after
        found.add(0, torque, 104.7, error + NOISE * chance.standard_normal())
    return {one.name: one for one in found.estimates(1.0)}


@pytest.mark.parametrize("reverses", [False, True])
@pytest.mark.parametrize("change", CHANGES)
def test_intervals_hold_the_change_of_backlash_and_compliance(change, reverses):
    true = {
        "backlash_change": PLAY if change == "play" else 0.0,
        "compliance_change": 1.0 / (1.0 - SOFTER) - 1.0 if change == "stiffness" else 0.0,
    }
    inside = {name: [] for name in true}
    for seed in range(100):
        found = followed(change, seed, reverses)
        for name, value in true.items():
            inside[name].append(found[name].low < value < found[name].high)
    for name in true:
        assert 0.90 <= np.mean(inside[name]) <= 1.0, name


def test_a_load_that_varies_widely_tells_play_from_stiffness():
    found = [followed("play", 1, wander=wander)["backlash_change"] for wander in (0.02, 0.1)]
    assert found[0].remedy == TORQUES and found[1].sd < 0.3 * found[0].sd
    assert found[1].value == pytest.approx(PLAY, rel=0.1)


def test_a_block_with_the_step_within_does_not_count():
    sharp, within = (followed(change, 2, True)["backlash_change"].sd for change in ("none", "play"))
    assert within == pytest.approx(sharp, rel=0.3)
