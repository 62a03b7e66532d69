"""Reads the channels of an MCAP file or bag: blocks of samples, and numbers in other messages.

Messages are of ROS 2 (CDR) or JSON. Numbers have the time of the header of their message, or that
of recording. Arrays with more than `MOST_CHANNELS` numbers, or of several lengths, are successive
samples without times.
"""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import mcap.records as mcap
import numpy as np
from numpy.typing import NDArray
from rosbags.typesys.store import Typestore

from ...text.escaping import one_line
from ..container.records import RecordingError, files_of, records_of
from ..ros2.sensor_topics import PULSES, SAMPLED
from ..ros2.typestore import types_in
from ..runs.block_order import since
from ..runs.sampled_files import channels_of, read_sampled
from .given_channel import MOST_CHANNELS, Array, Channel, FormatError

_UNREAD = ("header", "__msgtype__")


@dataclass
class _Numbers:
    """Numbers in the messages of one topic."""

    kind: str
    """Type of the messages."""
    stamps: list[int] = field(default_factory=list)
    """[ns]."""
    values: dict[str, list[Any]] = field(default_factory=dict)


def read_mcap(path: Path) -> list[Channel]:
    """Read the channels of an MCAP file or of a bag.

    Returns:
        The channels by name: of blocks those in the message, of other messages `topic/field`.

    Raises:
        FormatError: it has no number.
        RecordingError: it is no recording, or a message does not match its definition.
        OSError: it cannot be read.
    """
    remarks: list[str] = []
    sampled, numbers = read_sampled(path, remarks), dict[str, _Numbers]()
    for file in files_of(path):
        for topic, kind, stamp, message in _messages(file, remarks):
            _collect(numbers.setdefault(topic, _Numbers(kind)), message, stamp)
    stamps = [int(one.order.blocks["stamp"][0]) for one in sampled.values()]
    stamps += [min(one.stamps) for one in numbers.values() if one.values]
    begin = min(stamps, default=0)
    found = []
    for name, channel in channels_of(sampled).items():
        order, to_time = channel.sensor.order, since(begin)
        samples = channel.sensor.samples(to_time, -math.inf, math.inf)
        values, doubtful = samples.values[:, channel.number], tuple(order.remarks(to_time))
        found.append(Channel(name, values, channel.unit or None, samples.time, doubtful))
    for topic, one in numbers.items():
        found += _channels(topic.strip("/"), one, begin)
    if not found:
        raise FormatError("has no message with numbers")
    once = tuple(dict.fromkeys(remarks))
    return [one._replace(remarks=(*once, *one.remarks)) for one in found]


def _messages(file: Path, remarks: list[str]) -> Iterator[tuple[str, str, int, Any]]:
    """Topic, type, time of recording [ns], and contents of the messages that can be read."""
    schemas: dict[int, mcap.Schema] = {}
    known: dict[int, tuple[str, str, Typestore | None]] = {}
    skipped = Counter[str]()
    for record in records_of(file, remarks):
        if isinstance(record, mcap.Schema):
            schemas[record.id] = record
        elif isinstance(record, mcap.Channel):
            schema = schemas.get(record.schema_id)
            name = "" if schema is None else schema.name
            if name == SAMPLED:
                continue
            if record.message_encoding == "json":
                known[record.id] = record.topic, name, None
            elif schema is not None and (schema.encoding, record.message_encoding) == (
                "ros2msg",
                "cdr",
            ):
                known[record.id] = record.topic, name, types_in(file, record.topic, schema)
            else:
                skipped[f"{record.topic} ({record.message_encoding})"] += 1
        elif isinstance(record, mcap.Message) and record.channel_id in known:
            topic, kind, types = known[record.channel_id]
            yield topic, kind, record.log_time, _decoded(file, topic, kind, types, record)
    if skipped:
        shown = one_line(", ".join(skipped), 200)
        remarks.append(f"{file}: topics in other encodings than CDR and JSON are not read: {shown}")


def _decoded(
    file: Path, topic: str, kind: str, types: Typestore | None, record: mcap.Message
) -> Any:
    try:
        if types is None:
            return json.loads(record.data)
        return types.deserialize_cdr(record.data, kind)
    except Exception as reason:  # of many kinds: rosbags runs generated code
        why = one_line(str(reason) or type(reason).__name__, 200)
        raise RecordingError(f"{file}: {topic}: a message cannot be read: {why}") from None


def _collect(numbers: _Numbers, message: Any, recorded: int) -> None:
    """Append the numbers of a message that was recorded at a time [ns]."""
    stamp = getattr(getattr(message, "header", None), "stamp", None)
    set_ = 0 if stamp is None else stamp.sec * 1_000_000_000 + stamp.nanosec
    numbers.stamps.append(set_ or recorded)
    for name, value in _leaves("", message):
        numbers.values.setdefault(name, []).append(value)


def _leaves(name: str, value: Any) -> Iterator[tuple[str, Any]]:
    """Numbers and vectors of numbers in a message, by the path of their fields."""
    if isinstance(value, (bool, int, float)):
        yield name, float(value)
    elif isinstance(value, np.ndarray) and value.dtype.kind in "iufb":
        yield name, value.astype(np.float64)
    elif isinstance(value, list) and value and all(type(one) in (int, float) for one in value):
        yield name, np.array(value, dtype=np.float64)
    else:
        parts = value if isinstance(value, Mapping) else getattr(value, "__dict__", {})
        for part, inner in parts.items():
            if part not in _UNREAD:
                yield from _leaves(f"{name}/{part}" if name else part, inner)


def _channels(topic: str, numbers: _Numbers, begin: int) -> Iterator[Channel]:
    """The channels of a topic; fields that some messages lack are none."""
    stamps = 1e-9 * (np.array(numbers.stamps, dtype=np.int64) - begin).astype(np.float64)
    if numbers.kind == PULSES:
        first = zip(stamps, numbers.values["times"], strict=True)
        pulses = [begins + times - times[0] for begins, times in first if len(times)]
        yield Channel(topic, np.concatenate(pulses), "s")
        return
    for name, values in numbers.values.items():
        if len(values) != len(stamps):
            continue
        lengths = {np.size(one) for one in values}
        if len(lengths) > 1 or max(lengths) > MOST_CHANNELS:
            yield Channel(f"{topic}/{name}", np.concatenate([np.atleast_1d(v) for v in values]))
        elif len(values) > 1:
            yield from _columns(f"{topic}/{name}", np.array(values, dtype=np.float64), stamps)


def _columns(name: str, values: NDArray[Any], stamps: Array) -> Iterator[Channel]:
    if values.ndim == 1:
        yield Channel(name, values, time=stamps)
        return
    for number, column in enumerate(values.T, 1):
        yield Channel(f"{name}_{number}", column, time=stamps)
