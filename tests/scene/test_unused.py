"""Fields that a scene has but does not use."""

import pytest

import planetary_twin_py as pt
from planetary_twin_py.scene.unused import without_effect

PAPER = pt.load_scene("paper")
SHARING = PAPER.replace(**{"lubrication.boundary": "load_sharing"})
REGRESSION = PAPER.replace(**{"lubrication.traction": "schlenk"})


@pytest.mark.parametrize("name", ["boundary", "boundary_coefficient", "shear_stress"])
def test_a_regression_of_all_friction_leaves_parts_of_it_unused(name):
    field = f"lubrication.{name}"
    (line,) = without_effect(REGRESSION, [field])
    assert line.startswith(f"{field}: has no effect: lubrication.traction = schlenk")
    assert not list(without_effect(SHARING, [field]))


def test_the_boundary_coefficient_is_unused_with_asperities():
    field = "lubrication.boundary_coefficient"
    (line,) = without_effect(PAPER, [field])
    assert "lubrication.boundary = greenwood_tripp does not use it" in line
    assert "set lubrication.boundary = load_sharing" in line
    coefficients = (0.05, 0.5)
    low, high = (pt.simulate(PAPER.replace(**{field: each}), 0.002) for each in coefficients)
    assert (low.power_loss == high.power_loss).all()
    low, high = (pt.simulate(SHARING.replace(**{field: each}), 0.002) for each in coefficients)
    assert (low.power_loss != high.power_loss).any()
