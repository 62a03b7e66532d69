"""Fields that a scene has but does not use."""

import pytest

import planetary_twin_py as pt
from planetary_twin_py.scene.unused import without_effect

PAPER = pt.load_scene("paper")
REGRESSION = PAPER.replace(**{"lubrication.traction": "schlenk"})


@pytest.mark.parametrize("name", ["boundary", "boundary_coefficient", "shear_stress"])
def test_a_regression_of_all_friction_leaves_parts_of_it_unused(name):
    field = f"lubrication.{name}"
    (line,) = without_effect(REGRESSION, [field])
    assert line.startswith(f"{field}: has no effect: lubrication.traction = schlenk")
    assert not list(without_effect(PAPER, [field]))


def test_what_has_no_effect_changes_nothing():
    first, second = (
        pt.simulate(
            REGRESSION.replace(
                **{"lubrication.boundary": boundary, "lubrication.shear_stress": stress}
            ),
            0.002,
        )
        for boundary, stress in (("greenwood_tripp", 2e6), ("load_sharing", 5e6))
    )
    assert (first.power_loss == second.power_loss).all()
    assert first.power_loss.max() > 0.0
