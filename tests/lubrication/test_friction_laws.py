"""The friction laws of scenes are those of the core."""

import pytest
from lubrication.friction_laws import EXAMPLE_TABLE, FRICTION_LAWS

import planetary_twin_py as pt
from planetary_twin_py._core import TRACTION_LAWS
from planetary_twin_py.model.oil import build_oil

PAPER = pt.load_scene("paper").replace(**{"lubrication.friction_table": EXAMPLE_TABLE})


def test_a_scene_names_each_law_of_the_core():
    assert sorted(FRICTION_LAWS) == sorted(TRACTION_LAWS)


@pytest.mark.parametrize("law", FRICTION_LAWS)
def test_a_run_uses_the_law_that_its_scene_names(law):
    """And the friction power is part of a closed energy balance."""
    scene = PAPER.replace(**{"lubrication.traction": law})
    assert build_oil(scene, scene.operating_point).traction_law == TRACTION_LAWS[law]
    run = pt.simulate(scene, duration=0.02)
    assert run.power_loss.mean() > 0.0
    assert abs(run.energy.residual) < 1e-4 * run.energy.input
