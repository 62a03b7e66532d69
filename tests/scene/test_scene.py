"""Scenes from YAML: units in texts, and errors in one line that name the field."""

import math

import pytest
import yaml

import planetary_twin_py as pt
from planetary_twin_py.scene.load import load_changed

PAPER = pt.load_scene("paper")


def text(**changes):
    """The paper's scene as YAML, with other values at dotted paths."""
    data = PAPER.model_dump(mode="json")
    for path, value in changes.items():
        *parents, last = path.split("__")
        node = data
        for parent in parents:
            node = node[parent]
        node[last] = value
    return yaml.safe_dump(data)


def test_a_scene_is_unchanged_by_a_round_trip_through_yaml():
    assert pt.parse_scene(text()) == PAPER


@pytest.mark.parametrize(
    "written, meant", [("0.3 um", 3e-7), ("3e-4 mm", 3e-7), ("3e-7", 3e-7), (3e-7, 3e-7)]
)
def test_quantities_are_read_in_their_units(written, meant):
    scene = pt.parse_scene(text(operating_point__backlash=written))
    assert scene.operating_point.backlash == pytest.approx(meant)


@pytest.mark.parametrize("written", ["1000 1/min", "16 Hz", "1000 m", "fast"])
def test_speed_needs_a_unit_that_distinguishes_turns_and_radians(written):
    with pytest.raises(pt.SceneError, match="input_speed") as refusal:
        pt.load_scene("paper").replace(input_speed=written)
    assert repr(written) in str(refusal.value) and "\n" not in str(refusal.value)


CRACK = {"kind": "crack", "gear": "sun", "tooth": 0, "stiffness_loss": 0.2}


@pytest.mark.parametrize(
    "changes, words",
    [
        ({"mesh__stifness": 1.0}, ["mesh.stifness", "no such field"]),
        (
            {"operating_point__backlash": "0.2 kg"},
            ["backlash", "0.2 kg", "[kg] cannot be converted to m"],
        ),
        ({"operating_point__backlash": "0,3 um"}, ["backlash = '0,3 um': write a decimal point"]),
        ({"operating_point__oil_temperature": "70 C"}, ["oil_temperature = '70 C'", "write degC"]),
        ({"gearset__equivalent_mass__sun": "5e-4 kg m^2"}, ["equivalent_mass.sun", "J/r^2"]),
        ({"operating_point__input_speed": math.nan}, ["input_speed", "nan", "100000 rad/s"]),
        ({"operating_point__lambda_ratio": -1.0}, ["lambda_ratio", "-1", "within 0 and 10"]),
        ({"gearset__teeth__planet": 21}, ["30/21/70", "ring = sun + 2 planet = 72"]),
        ({"gearset__planet_angles": ["90 deg", "-30 deg", "210 deg"]}, ["90, -28.8, 208.8 deg"]),
        ({"gearset__held": "sun"}, ["drive.input.member", "sun"]),
        ({"gearset__held": "none"}, ["gearset.held", "'none'", "drive.second_input"]),
        (
            {"operating_point__input_speed": 1200.0},
            ["input_speed", "within -1100 and 1100 rad/s (drive.speed_limit)"],
        ),
        (
            {"operating_point__second_input_speed": 1.0},
            ["second_input_speed", "without a second input"],
        ),
        ({"mesh__sun_planet_stiffness": None}, ["mesh", "sun_planet_stiffness", "missing"]),
        ({"faults": [CRACK | {"tooth": 30}]}, ["faults.0.tooth", "30", "at most 29"]),
        ({"faults": [CRACK] * 65}, ["faults", "at most 64"]),
        ({"faults": "crack"}, ["faults = 'crack': must be a list"]),
        ({"faults": ["crack"]}, ["faults.0: must be a section with a kind"]),
        ({"gearset__teeth": 3}, ["gearset.teeth = 3: must be a section"]),
        ({"gearset__teeth__sun": 30.5}, ["gearset.teeth.sun = 30.5: must be a whole number"]),
        ({"lubrication__friction": "maybe"}, ["lubrication.friction = 'maybe': must be true or"]),
    ],
    ids=str,
)
def test_an_invalid_scene_is_refused_in_one_line(changes, words):
    with pytest.raises(pt.SceneError) as error:
        pt.parse_scene(text(**changes))
    message = str(error.value)
    assert "\n" not in message
    assert [word for word in words if word not in message] == []


def test_a_missing_file_is_refused_with_the_packaged_names():
    with pytest.raises(pt.SceneError, match=r"'nowhere'.*paper"):
        pt.load_scene("nowhere")


def test_all_errors_of_a_scene_are_listed_at_once_a_line_each():
    data = yaml.safe_load(text())
    data["mesh"] |= {"ramp": 0.5, "backlash": "gap"}
    data["gearset"]["modul"] = data["gearset"].pop("module")
    data["operating_point"]["input_speed"] = "3 m"
    data["faults"] = [CRACK | {"kind": "hole"}, CRACK | {"stiffness_loss": 2.0}]
    del data["drive"]["output"]
    with pytest.raises(pt.SceneError) as refusal:
        pt.parse_scene(yaml.safe_dump(data))
    assert sorted(str(refusal.value).split("\n  ")) == sorted(
        [
            "the scene has 7 errors:",
            "mesh.ramp = 0.5: must be a number within 0 and 0.2",
            "mesh.backlash = 'gap': must be 'dead_zone' or 'regulatory_factor'",
            "gearset.modul: no such field; did you mean module?",
            "input_speed = '3 m': [m] cannot be converted to rad/s; write, for example, rad/s or "
            "rpm",
            "faults.0.kind = 'hole': must be one of 'crack', 'spall', 'wear', 'pitch', "
            "'pin', 'bearing'",
            "faults.1.stiffness_loss = 2.0: must be a number within 0 and 0.9",
            "drive.output: missing",
        ]
    )


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("viscosity", "; did you mean lubrication.viscosity?"),
        ("viscosty", "; did you mean lubrication.viscosity?"),
        ("mesh.viscosity", "; did you mean lubrication.viscosity?"),
        ("backlas", "; did you mean backlash or mesh.backlash?"),
        ("supports.son.mass", ""),
    ],
)
def test_unknown_field_is_reported_with_most_similar_one_if_any(name, meant):
    with pytest.raises(pt.SceneError) as refusal:
        PAPER.replace(**{name: 1.0})
    assert str(refusal.value) == f"{name}: no such field{meant}"


@pytest.mark.parametrize(("name", "end"), [("papr", "; did you mean paper?"), ("zzz", "_stage")])
def test_unknown_scene_is_reported_with_most_similar_one_if_any(name, end):
    with pytest.raises(pt.SceneError, match="'" + name) as refusal:
        pt.load_scene(name)
    assert str(refusal.value).endswith(end)
    with pytest.raises(pt.SceneError, match="^base = '" + name) as refusal:
        pt.parse_scene(f"base: {name}")
    assert str(refusal.value).endswith(end)


def test_file_is_base_from_the_folder_of_the_file_that_names_it(tmp_path):
    (tmp_path / "inner").mkdir()
    (tmp_path / "own.yaml").write_text("base: paper\nname: own\noperating_point: {backlash: 2 um}")
    change = "base: ../own.yaml\nname: changed\ngearset: {face_width: 25 mm}"
    (tmp_path / "inner" / "changed.yaml").write_text(change)
    scene = pt.load_scene(tmp_path / "inner" / "changed.yaml")
    expected = {"name": "changed", "gearset.face_width": 0.025, "backlash": 2e-6}
    assert scene == pt.load_scene("paper").replace(**expected)


@pytest.mark.parametrize("base, reason", [("a.yaml", "leads back"), ("b.yaml", "No such")])
def test_a_base_that_is_no_other_file_is_refused_in_one_line(tmp_path, base, reason):
    (tmp_path / "a.yaml").write_text(f"base: {base}\nname: a")
    with pytest.raises(pt.SceneError, match=f"base = '{base}': {reason}") as refusal:
        pt.load_scene(tmp_path / "a.yaml")
    assert "\n" not in str(refusal.value)


def test_changes_repair_the_field_that_makes_a_file_invalid(tmp_path):
    file = tmp_path / "own.yaml"
    file.write_text("base: paper\nname: own\noperating_point: {backlash: -1 um}\nmesh: {ramp: 5}")
    with pytest.raises(pt.SceneError, match="backlash"):
        load_changed(file, {"mesh.ramp": 0.1})
    assert load_changed(file, {"mesh.ramp": 0.1, "backlash": "2 um"}) == pt.load_scene(
        "paper"
    ).replace(**{"name": "own", "mesh.ramp": 0.1, "backlash": 2e-6})
    with pytest.raises(pt.SceneError, match=r"mesh\.rmp: is not a field"):
        load_changed(file, {"mesh.rmp": 0.1})


def test_a_field_that_is_given_by_both_of_its_names_is_refused():
    with pytest.raises(pt.SceneError) as refusal:
        PAPER.replace(**{"operating_point.backlash": 1e-6, "backlash": 2e-6})
    assert (
        str(refusal.value) == "backlash: given twice, as operating_point.backlash and as backlash"
    )
