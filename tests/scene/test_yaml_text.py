"""YAML of a scene: a key that stands twice is refused, with both of its lines."""

import pytest
import yaml

import planetary_twin_py as pt
from planetary_twin_py.scene.yaml_text import read_yaml


def refusal(text):
    with pytest.raises(pt.SceneError) as error:
        pt.parse_scene(text)
    return str(error.value)


def test_a_key_that_stands_twice_is_refused_with_both_lines():
    text = "base: paper\nmesh:\n  ramp: 0.01\n  backlash: dead_zone\n  ramp: 0.02\n"
    assert refusal(text) == "mesh.ramp: given twice, in line 3 and in line 5"


def test_every_key_that_stands_twice_is_listed():
    text = "base: paper\nfaults:\n- {kind: crack, kind: wear}\nmesh: {}\nmesh: {}\n"
    assert refusal(text) == (
        "the scene has 2 errors:\n"
        "  faults.0.kind: given twice, in line 3 and in line 3\n"
        "  mesh: given twice, in line 4 and in line 5"
    )


def test_the_same_key_in_different_sections_is_none_that_stands_twice():
    scene = pt.parse_scene(
        "base: paper\nmesh: {backlash: dead_zone}\noperating_point: {backlash: 0}"
    )
    assert scene.operating_point.backlash == 0.0


@pytest.mark.parametrize(
    "text",
    ["a: [1, 2.5, x]\nb: {c: null}\n", "a: &x {b: 1}\nc: *x\n", "a: &x {b: 1}\nc: {<<: *x}", ""],
)
def test_other_text_is_read_as_yaml_reads_it(text):
    assert read_yaml(text) == yaml.safe_load(text)


def test_a_list_that_holds_itself_ends():
    assert pt.SceneError and refusal("&a [*a]").startswith("scene is not a YAML mapping")
