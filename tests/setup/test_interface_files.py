"""What a reader of the message files may rely on."""

import re
from pathlib import Path

import pytest

SPEC = Path(__file__).parents[2] / "msgs_spec"
MESSAGES = sorted(SPEC.glob("msg/*.msg"))
FILES = MESSAGES + sorted(SPEC.glob("srv/*.srv"))
FIELD = re.compile(r"^(?P<type>[\w/\[\]<=]+)\s+(?P<name>\w+)\s*(?:#\s*(?P<comment>.*))?$")
UNIT = re.compile(r"\[(-|m|s|h|1/h|rad|rad/s|rad/\(N m\)|N|N m|kg m\^2|W|Hz|K)\]")


def fields(path):
    lines = [line for line in path.read_text().splitlines() if line and line[0] not in "#-"]
    matches = [FIELD.match(line) for line in lines]
    assert all(matches), lines
    return [match.groupdict() for match in matches]


def name(path):
    return path.stem


@pytest.mark.parametrize("path", FILES, ids=name)
def test_every_field_is_explained(path):
    assert [f["name"] for f in fields(path) if not f["comment"]] == []


@pytest.mark.parametrize("path", FILES, ids=name)
def test_every_real_number_has_its_unit(path):
    # In SetOperatingPoint each has the unit of the quantity it names; events, blocks of samples and
    # levels of a sensor state their own.
    unitless = {"values", "samples", "size", "size_sd", "size_low", "size_high"}
    unitless |= {"mean", "rms", "peak", "mesh_line"}
    numbers = [f for f in fields(path) if f["type"].startswith("float")]
    missing = [f["name"] for f in numbers if not UNIT.match(f["comment"])]
    assert set(missing) <= unitless


@pytest.mark.parametrize("path", MESSAGES, ids=name)
def test_messages_begin_with_header_and_sequence(path):
    assert [(f["type"], f["name"]) for f in fields(path)[:2]] == [
        ("std_msgs/Header", "header"),
        ("uint64", "sequence"),
    ]


def test_every_interface_file_is_built():
    listed = re.findall(r'"((?:msg|srv)/\w+\.\w+)"', (SPEC / "CMakeLists.txt").read_text())
    assert sorted(listed) == sorted(str(path.relative_to(SPEC)) for path in FILES)
