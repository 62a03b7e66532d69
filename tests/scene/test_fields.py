"""Descriptions of fields agree with pydantic's JSON schema and with the values a scene accepts."""

import math
import re
from types import SimpleNamespace

import pytest

import planetary_twin_py as pt
from planetary_twin_py.scene.fields import scene_sections

SCHEMA = pt.Scene.model_json_schema()
FIELDS = {
    (section.kind, field.name): field for section in scene_sections() for field in section.fields
}


def resolved(schema):
    return SCHEMA["$defs"][schema["$ref"].rsplit("/", 1)[1]] if "$ref" in schema else schema


def one_of(schema):
    """The schema of a field without null, and with its other keys."""
    parts = schema.get("anyOf", schema.get("oneOf"))
    if parts is None:
        return [resolved(schema)]
    return [found for part in parts if part != {"type": "null"} for found in one_of(part)]


def walk(schema, name="", kind=""):
    """Kind, dotted name, keys of the field and schema of its value, for every field."""
    for own, field in schema["properties"].items():
        dotted = f"{name}.{own}".lstrip(".")
        values = one_of(field)
        yield kind, dotted, field, values[0]
        for value in values:
            items = one_of(value.get("items", {})) if value.get("type") == "array" else []
            for below in items or values:
                if "properties" not in below:
                    continue
                place, options = (f"{dotted}.N", items) if items else (dotted, values)
                several = sum("properties" in option for option in options) > 1
                yield from walk(below, place, tag(below) if several else "")


def tag(schema):
    """Value of the field by which a section is chosen from several."""
    own = schema["properties"]
    return next(own[name]["const"] for name in ("kind", "law") if name in own)


ALL = {(kind, name): SimpleNamespace(at=at, value=value) for kind, name, at, value in walk(SCHEMA)}


def test_the_fields_are_exactly_those_of_the_schema():
    assert len(ALL) > 120
    assert list(FIELDS) and set(FIELDS) == set(ALL)


def test_unit_choices_and_meaning_are_those_of_the_schema():
    for key, entry in ALL.items():
        shown, value = FIELDS[key], entry.value
        assert shown.meaning == entry.at["description"] and shown.meaning, key
        unit = entry.at.get("unit", "") or ("-" if is_number(value) else "")
        assert shown.unit == unit, key
        choices = value.get("enum", [value["const"]] if "const" in value else [])
        assert not choices or shown.range == ", ".join(choices), key


def is_number(value):
    return value.get("items", value).get("type") in ("number", "integer")


def test_ranges_are_those_of_the_schema():
    for key, entry in ALL.items():
        shown, value = FIELDS[key].range, entry.value
        if value.get("type") == "array":
            what = "values" if is_number(value) else "sections"
            assert shown == f"{value.get('minItems', 0)} to {value['maxItems']} {what}", key
        elif is_number(value):
            shown = re.match(r"[\[(].*?[\])]", shown)[0]  # choices may follow
            low, high = (float(end) for end in shown[1:-1].split(", "))
            lowest = {"[": value.get("minimum"), "(": value.get("exclusiveMinimum")}
            highest = {"]": value.get("maximum"), ")": value.get("exclusiveMaximum")}
            assert (lowest[shown[0]], highest[shown[-1]]) == (low, high), key


def test_defaults_are_those_of_the_schema():
    for key, entry in ALL.items():
        shown, default = FIELDS[key].default, entry.at.get("default", "required")
        if isinstance(default, dict):
            assert shown == "its defaults", key
        elif isinstance(default, float | int) and not isinstance(default, bool):
            assert float(shown) == pytest.approx(default, rel=1e-5), key
        else:
            assert shown == {None: "none", True: "true", False: "false"}.get(
                default if not isinstance(default, list) else None, default or "none"
            ), key


@pytest.mark.parametrize(
    "name, inside, outside",
    [
        ("mesh.ramp", (0.0, 0.2), (-1e-9, 0.2 + 1e-9)),
        ("lubrication.poisson_ratio", (0.0, math.nextafter(0.5, 0.0)), (0.5,)),
        ("drive.input.inertia", (math.nextafter(0.0, 1.0), 1e9), (0.0,)),
    ],
)
def test_a_scene_accepts_values_in_the_range_only(name, inside, outside):
    scene, shown = pt.load_scene("paper"), FIELDS["", name].range
    assert (
        shown
        == {
            "mesh.ramp": "[0, 0.2]",
            "lubrication.poisson_ratio": "[0, 0.5)",
            "drive.input.inertia": "(0, 1e+09]",
        }[name]
    )
    for value in inside:
        scene.replace(**{name: value})
    for value in outside:
        with pytest.raises(pt.SceneError):
            scene.replace(**{name: value})
