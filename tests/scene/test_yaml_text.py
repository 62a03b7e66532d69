"""YAML of a scene: a duplicate key is refused, with both of its lines."""

from itertools import pairwise

import pytest
import yaml

import planetary_twin_py as pt
from planetary_twin_py.scene.yaml_text import read_yaml


def refusal(text):
    with pytest.raises(pt.SceneError) as error:
        pt.parse_scene(text)
    return str(error.value)


def test_a_duplicate_key_is_refused_with_both_lines():
    text = "base: paper\nmesh:\n  ramp: 0.01\n  backlash: dead_zone\n  ramp: 0.02\n"
    assert refusal(text) == "mesh.ramp: given twice, in line 3 and in line 5"


def test_every_duplicate_key_is_listed():
    text = "base: paper\nfaults:\n- {kind: crack, kind: wear}\nmesh: {}\nmesh: {}\n"
    assert refusal(text) == (
        "the scene has 2 errors:\n"
        "  faults.0.kind: given twice, in line 3\n"
        "  mesh: given twice, in line 4 and in line 5"
    )


def test_the_same_key_in_different_sections_is_no_duplicate():
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


LAUGHS = "a: &a [lol, lol]\n" + "".join(
    f"{new}: &{new} [{', '.join([f'*{old}'] * 9)}]\n" for old, new in pairwise("abcdefghij")
)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("&a [*a]", "scene contains itself: *a is in &a"),
        (LAUGHS, "scene has too many values: must be at most 5000"),
        (f"base: {LAUGHS.replace(chr(10), ', ')}", "scene is not YAML: mapping values"),
        ("[" * 3000 + "]" * 3000, "scene is nested too deeply: must be at most 50 levels"),
        ("base: paper\nmesh: " + "{a: " * 3000 + "}" * 3000, "must be at most 50 levels"),
        ("faults:\n" + "- {kind: crack}\n" * 100_000, "1600008 characters: must be at most"),
        ("faults:\n" + "- {kind: x}\n" * 3000, "too many values: must be at most 5000"),
        ("a: " + "9" * 5000, "scene has a value that does not match its tag: Exceeds the limit"),
        ("a: !!timestamp x", "scene has a value that does not match its tag"),
        ("a: !!python/object/apply:os.system [x]", "could not determine a constructor"),
        ('a: "\\ud800"', "scene is not YAML: "),
        ('base: paper\n"\\e[31mred": 1', "\\x1b[31mred: no such field"),
        ("base: [paper]", "base = \"['paper']\": must be one of"),
    ],
)
def test_a_hostile_text_is_refused_in_one_short_line(text, reason):
    message = refusal(text)
    assert reason in message
    assert len(message) < 500 and "\n" not in message


def test_many_errors_are_a_short_list():
    message = refusal("base: paper\n" + "".join(f"{'k' * 900}{n}: 1\n" for n in range(100)))
    assert "and 70 more" in message and len(message) < 15_000


def test_aliases_of_a_scene_that_is_not_large_are_followed():
    scene = pt.parse_scene(
        "base: paper\nfaults: [&f {kind: wear, gear: sun, depth: 1 um}, *f, {<<: *f, tooth: 3}]"
    )
    assert [fault.tooth for fault in scene.faults] == [0, 0, 3]


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("operating_point: {input_torque: yes}", "input_torque = True: must be a number within"),
        ("gearset: {planet_angles: [yes, no]}", "gearset.planet_angles = [True, False]"),
        ("faults: [{kind: wear, gear: sun, depth: 1e-6, tooth: on}]", "faults.0.tooth = True"),
    ],
)
def test_yes_is_no_number(text, reason):
    assert reason in refusal(f"base: paper\n{text}")
    with pytest.raises(pt.SceneError, match="input_torque = True"):
        pt.load_scene("paper").replace(input_torque=True)
