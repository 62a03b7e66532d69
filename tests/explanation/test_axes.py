"""Description of held axes in `explain`, against statics and symmetry."""

import math

import pytest

import planetary_twin_py as pt
from planetary_twin_py.explanation.axes import meaning_of_held_axes

PAPER = pt.load_scene("paper")
# 5 planets of 30 + 70 teeth are in phase.
IN_PHASE = PAPER.replace(
    **{"gearset.planet_angles": tuple(2.0 * math.pi * k / 5 for k in range(5))}
)


def test_equal_planets_in_phase_would_not_move_an_axis():
    assert "would not move axes" in meaning_of_held_axes(IN_PHASE)


@pytest.mark.parametrize(
    "changes",
    [
        {"errors.pin_tangential": [1e-6, 0.0, 0.0, 0.0, 0.0]},
        {"mesh.runout.sun": 1e-8},
        {"errors.ring_offset": {"size": 1e-6}},
        {"gearset.planet_angles": tuple(2.0 * math.pi * k / 5 for k in range(4))},
        {"gearset.planet_angles": PAPER.gearset.planet_angles},  # out of phase
    ],
)
def test_anything_that_distinguishes_planets_would(changes):
    assert "would move axes" in meaning_of_held_axes(IN_PHASE.replace(**changes))


def test_with_bearings_both_factors_are_named():
    scene = pt.load_scene("floating_sun").replace(dynamics="torsional")
    held = pt.load_sharing(scene.replace(supports=None)).factor
    moving = pt.load_sharing(scene).factor
    text = meaning_of_held_axes(scene)
    assert f"{held:.3f} with held axes" in text and f"{moving:.3f} with the bearings" in text
    assert held > moving + 0.1
