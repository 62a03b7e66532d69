"""The fields of a message are read as rosbags decodes them, for every type."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from planetary_twin_py.recording.ros2.definitions import definition_of
from planetary_twin_py.recording.ros2.layout import Layout, LayoutError, Layouts

TYPES = get_typestore(Stores.ROS2_JAZZY)
for _name in ("GearboxState", "MeshWaveform", "OperatingPoint"):
    _kind = f"planetary_twin_msgs/msg/{_name}"
    _found = get_types_from_msg(definition_of(_kind), _kind)
    TYPES.register({k: v for k, v in _found.items() if k not in TYPES.types})
KINDS = sorted(TYPES.fielddefs)
SIZES = st.integers(0, 3)


@st.composite
def values(draw, field):
    sort, of = field
    if sort == Nodetype.NAME:
        return draw(messages(of))
    if sort == Nodetype.BASE:
        return draw(
            st.text(max_size=5).filter(str.isprintable) if of[0] == "string" else number(of[0])
        )
    element, size = of
    size = draw(SIZES) if sort == Nodetype.SEQUENCE else size
    if element[0] == Nodetype.BASE and element[1][0] != "string":
        form = {"bool": "?", "byte": "u1", "char": "u1"}.get(element[1][0], element[1][0])
        raw = np.random.default_rng(draw(st.integers(0, 9))).integers(0, 2, (size, 8), np.uint8)
        return raw.view(np.uint8)[:, : np.dtype(form).itemsize].copy().view(form).ravel()
    return [draw(values(element)) for _ in range(size)]


def number(name):
    if name == "bool":
        return st.booleans()
    if name.startswith("float"):
        return st.floats(width=int(name[5:]))
    # rosbags takes a byte for a signed number, unlike arrays of bytes.
    low, high = (
        (0, {"byte": 127, "char": 255}[name])
        if name in ("byte", "char")
        else (np.iinfo(name).min, np.iinfo(name).max)
    )
    return st.integers(int(low), int(high))


def messages(kind):
    fields = TYPES.fielddefs[kind][1]
    return st.builds(TYPES.types[kind], **{name: values(field) for name, field in fields})


def assert_same(row, message):
    """A row of a structured array, and a message that rosbags has decoded."""
    if dataclasses.is_dataclass(message):
        for name, _ in TYPES.fielddefs[message.__msgtype__][1]:
            assert_same(row[name], getattr(message, name))
    elif isinstance(message, list):
        assert len(row.dtype) == len(message)
        for k, element in enumerate(message):
            assert_same(row[str(k)], element)
    elif isinstance(message, str):
        assert row.decode() == message
    else:
        np.testing.assert_array_equal(row, message)


@pytest.mark.slow
@settings(max_examples=200, deadline=None)
@given(data=st.data(), little_endian=st.booleans())
def test_fields_are_those_that_rosbags_decodes(data, little_endian):
    kind = data.draw(st.sampled_from(KINDS))
    written = data.draw(messages(kind))
    raw = bytes(TYPES.serialize_cdr(written, kind, little_endian=little_endian))
    (rows,) = Layouts(TYPES.fielddefs, kind).arrays([raw, raw])
    assert rows.shape == (2,)
    for row in rows:
        assert_same(row, TYPES.deserialize_cdr(raw, kind))


def diagnostics(names):
    status = TYPES.types["diagnostic_msgs/msg/DiagnosticStatus"]
    return TYPES.types["diagnostic_msgs/msg/DiagnosticArray"](
        TYPES.types["std_msgs/msg/Header"](TYPES.types["builtin_interfaces/msg/Time"](1, 2), ""),
        [status(0, name, "", "none", []) for name in names],
    )


def test_layouts_of_the_same_size_are_distinguished():
    kind = "diagnostic_msgs/msg/DiagnosticArray"
    order = [("ab", "abcdef"), ("ab", "abcdef"), ("abcdef", "ab"), ("cd", "ghijkl"), ("a",)]
    raw = [bytes(TYPES.serialize_cdr(diagnostics(names), kind)) for names in order]
    assert len({len(message) for message in raw[:4]}) == 1
    arrays = list(Layouts(TYPES.fielddefs, kind).arrays(raw))
    assert [len(rows) for rows in arrays] == [2, 1, 1, 1]
    found = [
        [str(status["name"], "utf-8") for status in row["status"]] for a in arrays for row in a
    ]
    assert found == [list(names) for names in order]


def test_no_message_is_read_beyond_its_end():
    kind = "sensor_msgs/msg/JointState"
    numbers = np.arange(3.0)
    header = diagnostics(()).header
    whole = bytes(
        TYPES.serialize_cdr(TYPES.types[kind](header, ["a", "b"], numbers, numbers, numbers), kind)
    )
    for size in range(len(whole)):
        with pytest.raises(LayoutError):
            Layout(TYPES.fielddefs, kind, whole[:size])
    assert Layout(TYPES.fielddefs, kind, whole + b"\0\0\0").dtype.itemsize == len(whole) + 3
    with pytest.raises(LayoutError, match="bytes after the last field"):
        Layout(TYPES.fielddefs, kind, whole + bytes(4))
    with pytest.raises(LayoutError, match="must be plain CDR"):
        Layout(TYPES.fielddefs, kind, b"\0\7" + whole[2:])
