"""Files that harm who reads them without care: scenes, recordings, tables."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

from mcap.records import Attachment, Channel, Message, Metadata, Schema
from mcap.stream_reader import StreamReader
from mcap.writer import Writer

Alter = Callable[[Any], Any]

LAUGHS = "a: &a [lol, lol]\n" + "".join(
    f"{new}: &{new} [{', '.join([f'*{old}'] * 9)}]\n" for old, new in pairwise("abcdefghij")
)
DEEP = "[" * 3000 + "]" * 3000

SCENES = {
    "laughs": LAUGHS.encode(),
    "laughs beside a base": f"base: paper\n{LAUGHS}".encode(),
    "laughs as a base": f"{LAUGHS}base: *j\n".encode(),
    "laughs as a value": f"base: paper\n{LAUGHS}operating_point: {{input_torque: *j}}\n".encode(),
    "deep": DEEP.encode(),
    "deep mappings": b"base: paper\nmesh: " + b"{a: " * 3000 + b"}" * 3000,
    "100 000 faults": b"base: paper\nfaults:\n" + b"- {kind: crack, gear: sun}\n" * 100_000,
    "not UTF-8": b"base: paper\nname: \xff\xfe\n",
    "a torque of yes": b"base: paper\noperating_point: {input_torque: yes}\n",
    "escapes in a key": b'base: paper\n"\\e[31mred\\e]0;title\\a": 1\n',
    "a number without end": b"base: paper\noil_temperature: " + b"9" * 90_000,
    "a tag": b"base: paper\nname: !!python/object/apply:os.system [id]\n",
    "holds itself": b"base: &a [*a]\n",
    "zeros": bytes(1_000_000),
}


def of(kind: type, ending: str, **changes: Any) -> Alter:
    """Change fields of the records of a kind whose name, or topic, ends so."""

    def alter(record: Any) -> Any:
        named = getattr(record, "topic", getattr(record, "name", ""))
        if isinstance(record, kind) and named.endswith(ending):
            return replace(
                record, **{k: v(record) if callable(v) else v for k, v in changes.items()}
            )
        return record

    return alter


def state_of(**changes: Any) -> Alter:
    """Change the schema of GearboxState."""
    return of(Schema, "GearboxState", **changes)


def string(text: str | bytes) -> bytes:
    """A serialised std_msgs/String."""
    data = (text.encode() if isinstance(text, str) else text) + b"\0"
    return b"\0\1\0\0" + len(data).to_bytes(4, "little") + data


def fan(record: Any) -> bytes:
    """The definition of a record with 2^40 fields more, in 40 types."""
    parts = [f"MSG: x/T{n}\nT{n + 1} a\nT{n + 1} b\n" for n in range(40)]
    rule = "=" * 80 + "\n"
    last = "MSG: x/T40\nfloat64 value\n"
    return b"x/T0 more\n" + record.data + ("\n" + rule + rule.join([*parts, last])).encode()


REFUSED: dict[str, Alter] = {
    "a definition that holds itself": state_of(data=lambda s: b"GearboxState more\n" + s.data),
    "a definition of 2^40 fields": state_of(data=fan),
    "an array of 4 billion messages": state_of(
        data=lambda s: b"std_msgs/Header[4000000000] more\n" + s.data
    ),
    "an array of 2^64 numbers": state_of(
        data=lambda s: s.data.replace(b"float64 simulated_time", b"float64[18446744073709551616] q")
    ),
    "a constant of 50 000 digits": state_of(
        data=lambda s: b"int32 MORE=" + b"9" * 50_000 + b"\n" + s.data
    ),
    "a definition that is not UTF-8": state_of(data=lambda s: b"# \xff\xfe\n" + s.data),
    "a definition of 1 MB": state_of(data=lambda s: b"#" * 1_000_000 + b"\n" + s.data),
    "a definition without its fields": state_of(data=b"float64 value\n"),
    "a definition of nothing": state_of(data=b""),
    "an encoding that is none": state_of(encoding="protobuf"),
}
"""Recordings of which `info` reads nothing."""

READ: dict[str, Alter] = {
    "a schema of another name": state_of(name="\x1b[31m/msg"),
    "a schema without a name": state_of(name=""),
    "profiles that laugh": of(Channel, "", metadata={"offered_qos_profiles": LAUGHS}),
    "profiles that are deep": of(Channel, "", metadata={"offered_qos_profiles": DEEP}),
    "profiles of another kind": of(Channel, "", metadata={"offered_qos_profiles": "[1, {a: ["}),
    "profiles of another type": of(Channel, "", metadata={"offered_qos_profiles": "[{depth: x}]"}),
    "an attachment that is not UTF-8": of(Attachment, "", data=b"\xff\xfe"),
    "an attachment that laughs": of(Attachment, "", data=LAUGHS.encode()),
    "an attachment that is deep": of(Attachment, "", data=DEEP.encode()),
    "an account without fields": of(Metadata, "", metadata={}),
    "escapes in names": of(Channel, "joint_states", topic="/a\x1b[2J\x1b]0;b\x07/joint_states"),
}
"""Recordings of which `info` reads what is sound."""


def messages_of(topic: str, data: Callable[[bytes], bytes]) -> Alter:
    """Change the messages of a topic."""
    channels: set[int] = set()

    def alter(record: Any) -> Any:
        if isinstance(record, Channel) and record.topic.endswith(topic):
            channels.add(record.id)
        if isinstance(record, Message) and record.channel_id in channels:
            return replace(record, data=data(record.data))
        return record

    return alter


MESSAGES = {
    "an origin that laughs": ("run_origin", lambda data: string(LAUGHS)),
    "an origin that is deep": ("run_origin", lambda data: string(DEEP)),
    "an origin that is not UTF-8": ("run_origin", lambda data: string(b"\xff")),
    "a state that is cut": ("gearbox_state", lambda data: data[:100]),
    "a state that is compressed": ("gearbox_state", lambda data: b"\x28\xb5\x2f\xfd" + data),
    "a state of nothing": ("gearbox_state", lambda data: b""),
    "a text of 4 billion bytes": ("operating_point", lambda data: data[:12] + b"\xff" * 40),
    "a wave of 4 billion samples": ("mesh_waveform", lambda data: data[:60] + b"\xff" * 4),
}
"""Topic, and what its messages are made of: none of these recordings can be verified."""


def rewritten(source: Path, target: Path, alter: Alter) -> Path:
    """A copy of a recording with its records altered, whole by every checksum."""
    with source.open("rb") as stream, target.open("wb") as out:
        writer = Writer(out)
        writer.start("ros2", "hostile")
        schemas, channels = {}, {}
        for record in map(alter, StreamReader(stream).records):
            if isinstance(record, Schema):
                schemas[record.id] = writer.register_schema(
                    record.name, record.encoding, record.data
                )
            elif isinstance(record, Channel) and record.id not in channels:
                channels[record.id] = writer.register_channel(
                    record.topic,
                    record.message_encoding,
                    schemas[record.schema_id],
                    record.metadata,
                )
            elif isinstance(record, Message):
                number, times = channels[record.channel_id], (record.log_time, record.publish_time)
                writer.add_message(number, times[0], record.data, times[1], record.sequence)
            elif isinstance(record, Attachment):
                times = record.create_time, record.log_time
                writer.add_attachment(*times, record.name, record.media_type, record.data)
            elif isinstance(record, Metadata):
                writer.add_metadata(record.name, record.metadata)
        writer.finish()
    return target


def many_channels(target: Path, count: int = 65_000) -> Path:
    """A recording with as many topics as there can be, each with a message."""
    with target.open("wb") as out:
        writer = Writer(out)
        writer.start("ros2", "hostile")
        schema = writer.register_schema("std_msgs/msg/Bool", "ros2msg", b"bool data\n")
        for n in range(count):
            metadata = {"offered_qos_profiles": f"- {{depth: {n}, durability: transient_local}}"}
            channel = writer.register_channel(f"/t{n}", "cdr", schema, metadata)
            writer.add_message(channel, n + 1, b"\0\1\0\0\1", n + 1)
        writer.finish()
    return target
