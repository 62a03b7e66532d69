"""YAML of a scene: a duplicate key is refused, with both of its lines."""

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


@pytest.mark.parametrize(
    "text",
    ["a: [1, 2.5, x]\nb: {c: null}\n", "a: &x {b: 1}\nc: *x\n", "a: &x {b: 1}\nc: {<<: *x}", ""],
)
def test_other_text_is_read_as_yaml_reads_it(text):
    assert read_yaml(text) == yaml.safe_load(text)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("faults:\n" + "- {kind: crack}\n" * 100_000, "scene has more than 100000 characters"),
        ("base: paper\na: " + "9" * 5000, "a: no such field"),
        ("a: !!int 0x10", "does not match its tag: '0x10' is not a whole number in decimal digits"),
        ("a: !!float 1:30", "does not match its tag: '1:30' is not a decimal number"),
        ("a: !!timestamp x", "scene has a value that does not match its tag"),
        ("a: !!python/object/apply:os.system [x]", "could not determine a constructor"),
        ('base: paper\n"\\e[31mred": 1', "\\x1b[31mred: no such field"),
        ("base: [paper]", "base = \"['paper']\": must be a file NAME.yaml"),
    ],
)
def test_a_text_that_is_no_scene_is_refused_in_one_line(text, reason):
    message = refusal(text)
    assert reason in message
    assert len(message) < 500 and "\n" not in message


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


OTHER_NUMBERS = {
    "in base 60": "1:30",
    "hexadecimal": "0x1F",
    "octal of YAML 1.2": "0o17",
    "with an underscore": "1_0",
    "with an underscore and a unit": "1_0 N m",
    "in Arabic-Indic digits": "\u0661\u0660",
    "of 5000 digits": "9" * 5000,
}


@pytest.mark.parametrize("number", OTHER_NUMBERS.values(), ids=OTHER_NUMBERS)
def test_a_number_that_is_not_decimal_is_refused(tmp_path, number):
    file = tmp_path / "scene.yaml"
    file.write_text(f"base: paper\noperating_point: {{input_torque: {number}}}\n", "utf-8")
    with pytest.raises(pt.SceneError) as error:
        pt.load_scene(file)
    line = str(error.value)
    assert line.startswith(f"{file}: input_torque = ") and len(line) < 600 and "\n" not in line
    assert "must be a number within -1e+09 and 1e+09 N m, and within drive.torque_limit" in line
    with pytest.raises(pt.SceneError, match=r"^gearset\.teeth\.sun = .*: must be a whole number"):
        pt.parse_scene(f"base: paper\ngearset: {{teeth: {{sun: {number}}}}}")
    with pytest.raises(pt.SceneError, match=r"^input_torque = "):
        pt.load_scene("paper").replace(input_torque=number.strip("'"))


def test_an_error_of_a_file_names_the_file_and_the_line(tmp_path):
    file = tmp_path / "scene.yaml"
    file.write_text("base: paper\nmesh: a: b\n", "utf-8")
    with pytest.raises(pt.SceneError) as error:
        pt.load_scene(file)
    assert str(error.value) == (
        f"{file}: scene is not YAML: mapping values are not allowed in this context at line 2, "
        "column 8"
    )
