"""A split bag repeats latched messages at the start of each file; whoever reads it whole wants one.

Publisher's time, number and content tell a repeated message; it is received again, but sent once.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mcap.records import Channel, Message

from ..container.records import records_of
from .metadata import is_latched, read_offered_qos


class Repeats:
    """Knows the latched messages of a bag, whose files it is shown one after another."""

    def __init__(self) -> None:
        self._seen: set[tuple[str, int, int, int]] = set()
        self._latched: dict[int, str] = {}

    def next_file(self) -> None:
        """Numbers of channels are those of another file from now on."""
        self._latched = {}

    def repeated(self, record: Any) -> bool:
        """Whether a record is a message that has been shown before."""
        if isinstance(record, Channel):
            if _latched(record):
                self._latched[record.id] = record.topic
        elif isinstance(record, Message) and record.channel_id in self._latched:
            return self.known(self._latched[record.channel_id], record)
        return False

    def is_latched(self, channel: int) -> bool:
        """Whether a channel of the present file, which was shown, is latched."""
        return channel in self._latched

    def known(self, topic: str, message: Message) -> bool:
        """Whether a message of a latched topic has been shown before."""
        mark = topic, message.publish_time, message.sequence, hash(message.data)
        if mark in self._seen:
            return True
        self._seen.add(mark)
        return False


def unrepeated(file: Path, remarks: list[str], repeats: Repeats) -> Iterator[Any]:
    """The records of the next file of a bag but messages that those before had, too."""
    repeats.next_file()
    for record in records_of(file, remarks):
        if not repeats.repeated(record):
            yield record


def _latched(channel: Channel) -> bool:
    try:
        return is_latched(read_offered_qos(channel.metadata.get("offered_qos_profiles", "")))
    except ValueError:  # no profiles as rosbag2 writes them
        return False
