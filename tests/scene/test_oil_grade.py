"""A grade defines the viscosity of the oil, however the scene is made; nothing contradicts it."""

import json

import pytest

from planetary_twin_py import load_scene, parse_scene
from planetary_twin_py.scene.quantity import SceneError

PAPER = load_scene("paper")
GRADE = PAPER.replace(**{"lubrication.iso_vg": 220})


def oil(scene):
    data = scene.lubrication
    return data.iso_vg, data.viscosity, data.reference_temperature


def test_a_grade_is_the_kinematic_viscosity_at_40_degrees():
    expected = (220, pytest.approx(220e-6 * 890.0, rel=1e-12), 313.15)
    assert oil(GRADE) == expected
    assert oil(parse_scene("base: paper\nlubrication: {iso_vg: 220}")) == expected
    assert oil(parse_scene(GRADE.model_dump_json())) == expected


def test_what_changes_later_replaces_what_was_given_before():
    changed = GRADE.replace(**{"lubrication.oil_density": "0.85 g/cm^3"})
    assert oil(changed)[1] == pytest.approx(220e-6 * 850.0, rel=1e-12)
    assert oil(GRADE.replace(**{"lubrication.iso_vg": 68.0}))[0] == 68
    assert oil(GRADE.replace(**{"lubrication.viscosity": 0.05})) == (None, 0.05, 313.15)
    assert oil(GRADE.replace(**{"lubrication.iso_vg": None})) == (None, *oil(GRADE)[1:])
    flat = GRADE.replace(**{"lubrication.viscosity_index": 160.0}).lubrication.viscosity_slope
    assert flat < GRADE.lubrication.viscosity_slope


@pytest.mark.parametrize(
    "changes, reason",
    [
        ({"iso_vg": 221}, "iso_vg = 221: must be one of 10, 15, 22, 32"),
        ({"iso_vg": "VG 220"}, "lubrication.iso_vg = 'VG 220': must be a whole number"),
        (
            {"iso_vg": 220, "viscosity_index": 500},
            "viscosity_index = 500: must be within 0 and 400",
        ),
        ({"iso_vg": 220, "viscosity": 0.08}, "viscosity = 0.08: iso_vg = 220 defines it, 0.1958"),
        ({"iso_vg": 220, "viscosity_slope": 3.0}, "viscosity_slope = 3.0: iso_vg = 220 defines it"),
    ],
)
def test_grade_that_does_not_exist_or_is_contradicted_is_refused(changes, reason):
    named = {f"lubrication.{name}": value for name, value in changes.items()}
    text = json.dumps({"base": "paper", "lubrication": changes})
    for make in (lambda: PAPER.replace(**named), lambda: parse_scene(text)):
        with pytest.raises(SceneError) as refusal:
            make()
        assert reason in str(refusal.value)
