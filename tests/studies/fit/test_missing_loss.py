"""Losses that a model lacks, from residuals of known lines."""

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.studies.fit.least_squares import search
from planetary_twin_py.studies.fit.missing_loss import find_missing_loss
from planetary_twin_py.studies.fit.parameter import Parameter

PAPER = pt.load_scene("paper")
SPEED, TORQUE = (a.ravel() for a in np.meshgrid([1.0, 2.0, 3.0], [1.0, 5.0, 9.0]))
EFFECT = {"losses.sun_drag.coulomb": np.ones(9), "losses.sun_drag.viscous": SPEED}
FRICTION = Parameter("friction", "", 0.0, 0.5, 0.1)


def residuals(lost, friction, **drag):
    """Torques of a loss `friction` times the torque, plus the drag, minus the measured torque."""
    return (friction * TORQUE + sum(EFFECT[k] * v for k, v in drag.items()) - lost) / 1e-3


def missing_loss(lost, scene=PAPER):
    minimum = search(lambda points: [residuals(lost, p[0]) for p in points], (FRICTION,))
    return find_missing_loss(
        scene, (FRICTION,), minimum, lambda k, v: residuals(lost, minimum.values[0], **{k: v})
    )


@pytest.mark.parametrize("name", EFFECT)
@pytest.mark.parametrize("friction", [0.2, 0.48])
def test_an_existing_drag_is_named_with_its_value(name, friction):
    """With a friction of 0.48, the search reaches the end of the range and returns from it."""
    found = missing_loss(friction * TORQUE + 0.7 * EFFECT[name])
    assert found.field == name
    assert found.value == pytest.approx(0.7, rel=1e-6) and found.sum < 1e-6


def test_a_loss_that_follows_the_load_is_no_drag():
    assert missing_loss(0.1 * TORQUE**2) is None


def test_less_loss_than_the_model_has_is_no_drag():
    assert missing_loss(0.2 * TORQUE - 0.7) is None


def test_a_drag_that_the_scene_has_is_not_missing():
    both = PAPER.replace(**{"losses.sun_drag": {"coulomb": 0.1, "viscous": 0.1}})
    assert missing_loss(0.2 * TORQUE + 0.7, both) is None
