"""Recordings of other versions, whose messages have fewer or more fields."""

import re

import numpy as np
import pytest
from altered_recording import rewritten
from mcap.records import Channel, Message, Schema
from mcap.stream_reader import StreamReader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from twin_recording import NAMESPACE

from planetary_twin_py.recording.container.records import RecordingError
from planetary_twin_py.recording.runs.branch import Branch
from planetary_twin_py.recording.runs.info import read_info
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.recording.runs.verify import verify
from planetary_twin_py.recording.runs.what_if import resimulate
from planetary_twin_py.recording.tables.export import Export, export

STATE = "planetary_twin_msgs/msg/GearboxState"
POINT = "planetary_twin_msgs/msg/OperatingPoint"


def types_of(definition, kind):
    types = get_typestore(Stores.EMPTY)
    types.register(get_types_from_msg(definition, kind))
    return types


def as_of(sound, target, kind, define):
    """The recording as written by a version that defines messages of `kind` differently."""
    with sound.open("rb") as stream:
        records = list(StreamReader(stream).records)
    schema = next(r for r in records if isinstance(r, Schema) and r.name == kind)
    channels = [r.id for r in records if isinstance(r, Channel) and r.schema_id == schema.id]
    text = schema.data.decode()
    other = define(text)
    assert other != text
    before, after = types_of(text, kind), types_of(other, kind)
    names = [name for name, _ in after.fielddefs[kind][1]]

    def alter(record):
        if isinstance(record, Schema) and record.name == kind:
            record.data = other.encode()
        elif isinstance(record, Message) and record.channel_id in channels:
            message = before.deserialize_cdr(record.data, kind)
            values = {name: getattr(message, name, 7.0) for name in names}
            stamp = message.header.stamp
            time = after.types["builtin_interfaces/msg/Time"](stamp.sec, stamp.nanosec)
            frame = message.header.frame_id
            values["header"] = after.types["std_msgs/msg/Header"](time, frame)
            record.data = bytes(after.serialize_cdr(after.types[kind](**values), kind))
        return record

    return rewritten(sound, target, alter)


def without(field):
    return lambda text: re.sub(rf"^\S+ +{field} .*\n", "", text, flags=re.MULTILINE)


def test_a_field_that_a_recording_lacks_is_nan_and_reported(sound, tmp_path):
    file = as_of(sound, tmp_path / "old.mcap", STATE, without("sun_planet_film_thickness"))
    old, new = read_recording(file), read_recording(sound)
    assert np.isnan(old.per_mesh("film_thickness")[:, :3]).all()
    np.testing.assert_array_equal(old.per_mesh("dte_mean"), new.per_mesh("dte_mean"))
    prefix = f"{NAMESPACE}/gearbox_state: recorded by another version, without "
    assert old.remarks == [f"{prefix}sun_planet_film_thickness"] and new.remarks == []


def test_the_fields_of_an_older_recording_are_verified(sound, tmp_path):
    file = as_of(sound, tmp_path / "old.mcap", STATE, without("efficiency"))
    verdict = verify(file, NAMESPACE)
    assert verdict.identical and verdict.values == verify(sound, NAMESPACE).values - 41


def test_a_table_has_no_column_for_a_missing_field(sound, tmp_path):
    file = as_of(sound, tmp_path / "old.mcap", STATE, without("efficiency"))
    (table,) = export(file, Export(tmp_path / "table.csv", topics=["gearbox_state"])).rows
    heading = table.read_text().partition("\n")[0]
    assert "power_loss" in heading and "efficiency" not in heading


def test_a_parameter_that_did_not_exist_has_the_scene_s_value(sound, tmp_path):
    file = as_of(sound, tmp_path / "old.mcap", POINT, without("oil_temperature"))
    assert verify(file, NAMESPACE).identical
    assert all("oil_temperature" not in change.values for change in read_info(file).changes)
    made = resimulate(file, NAMESPACE, Branch({"backlash": 1e-6}), tmp_path / "branch")
    assert verify(made.file, NAMESPACE).identical


def test_a_command_that_needs_a_missing_field_names_it(sound, tmp_path):
    file = as_of(sound, tmp_path / "old.mcap", STATE, without("tolerance"))
    assert read_info(file).simulated == read_info(sound).simulated
    with pytest.raises(RecordingError, match="gearbox_state has no field tolerance in this"):
        verify(file, NAMESPACE)


def test_an_additional_field_is_kept_and_does_no_harm(sound, tmp_path):
    file = as_of(sound, tmp_path / "new.mcap", STATE, lambda text: "float64 later\n" + text)
    recording = read_recording(file)
    assert (recording.state["later"] == 7.0).all() and not recording.remarks
    assert verify(file, NAMESPACE).identical
    assert read_info(file).simulated == read_info(sound).simulated
