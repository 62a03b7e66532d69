"""Signatures of cracked teeth against runs with other teeth, loads and sizes."""

import numpy as np
import pytest
from tiers import first_rows

import planetary_twin_py as pt
from planetary_twin_py.following.teeth import signatures as module
from planetary_twin_py.following.teeth.signatures import signatures
from planetary_twin_py.following.train import followed_train

SCENE = pt.load_scene("paper")
SPEED = SCENE.operating_point.input_speed


@pytest.fixture(scope="module")
def found():
    return signatures(SCENE, 63.0, SPEED)


def of_tooth(gear, tooth, loss=module.LOSS, scene=SCENE):
    """Deviation per unit of loss, from a run with this tooth cracked."""
    kind, _, planet = gear.partition("_")
    more = {"planet": int(planet)} if planet else {}
    fault = {"kind": "crack", "gear": kind, "tooth": tooth, "stiffness_loss": loss} | more
    train = followed_train(SCENE)
    return module._deviation(scene.replace(faults=[fault]), train.teeth[gear]) / loss


def likeness(one, other):
    return float(np.sum(one * other) / np.sqrt(np.sum(one**2) * np.sum(other**2)))


@pytest.mark.parametrize(
    ("gear", "tooth"), first_rows(1, [("planet_2", 7), ("sun", 11), ("ring", 33)])
)
def test_another_tooth_is_a_shift_of_whole_cycles(found, gear, tooth):
    run = of_tooth(gear, tooth)
    shifted = np.roll(found.gears[gear], tooth, axis=0)
    assert likeness(run, shifted) > 0.999
    assert np.linalg.norm(run) == pytest.approx(np.linalg.norm(shifted), rel=0.01)


def test_it_is_linear_in_the_loss(found):
    small = of_tooth("sun", 0, 0.02)
    assert likeness(small, found.gears["sun"]) > 0.999
    assert np.linalg.norm(small) == pytest.approx(np.linalg.norm(found.gears["sun"]), rel=0.04)


def test_it_grows_with_the_torque(found):
    heavy = of_tooth("sun", 0, scene=SCENE.replace(input_torque=1.3 * 63.0))
    assert np.linalg.norm(heavy) == pytest.approx(
        1.3 * np.linalg.norm(found.gears["sun"]), rel=0.01
    )


def test_the_compliance_is_that_of_two_loads(found):
    line = np.polyfit(
        [50.0, 76.0],
        [np.mean(module._error(SCENE.replace(input_torque=t), 14)[1]) for t in (50.0, 76.0)], 1,
    )  # fmt: skip
    assert found.compliance == pytest.approx(line[0], rel=0.01)
