"""A split bag repeats latched messages at the start of each file; whoever reads it whole wants one.

Publisher's time, number and content tell a repeated message; it is received again, but sent once.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

import yaml
from mcap.records import Channel, Message

from .rosbag2 import is_latched

Seen = set[tuple[str, int, int, int]]


def unrepeated(records: Iterable[Any], seen: Seen) -> Iterator[Any]:
    """The records of one file without the messages `seen` in those before, to which it adds."""
    latched: dict[int, str] = {}
    for record in records:
        if isinstance(record, Channel):
            if _latched(record):
                latched[record.id] = record.topic
        elif isinstance(record, Message) and record.channel_id in latched:
            topic = latched[record.channel_id]
            mark = topic, record.publish_time, record.sequence, hash(record.data)
            if mark in seen:
                continue
            seen.add(mark)
        yield record


def _latched(channel: Channel) -> bool:
    try:
        return is_latched(yaml.safe_load(channel.metadata.get("offered_qos_profiles", "")) or [])
    except (yaml.YAMLError, AttributeError):  # no profiles as rosbag2 writes them
        return False
