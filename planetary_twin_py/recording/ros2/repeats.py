"""Removes the latched messages that a split bag repeats at the start of each file.

A repeated message has the same publish time, sequence number and content, but another log time.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mcap.records import Channel, Message

from ..container.log_order import records_in_log_order
from .metadata import kept_by, read_offered_qos


class Repeats:
    """Detects repeated latched messages of a bag, given its files in order."""

    def __init__(self) -> None:
        self._seen: set[tuple[str, int, int, int]] = set()
        self._latched: dict[int, str] = {}
        self.counts = Counter[str]()
        """Repeated messages in the current file, by topic."""

    def next_file(self) -> None:
        """Start the next file, whose channel numbers are independent."""
        self._latched = {}
        self.counts.clear()

    def repeated(self, record: Any) -> bool:
        """Whether a record is a message that has occurred before."""
        if isinstance(record, Channel):
            if kept_by(read_offered_qos(record.metadata.get("offered_qos_profiles", ""))):
                self._latched[record.id] = record.topic
        elif isinstance(record, Message) and record.channel_id in self._latched:
            topic = self._latched[record.channel_id]
            if self.known(topic, record):
                self.counts[topic] += 1
                return True
        return False

    def is_latched(self, channel: int) -> bool:
        """Whether a channel of the current file is latched."""
        return channel in self._latched

    def known(self, topic: str, message: Message) -> bool:
        """Whether a message of a latched topic has occurred before."""
        identity = topic, message.publish_time, message.sequence, hash(message.data)
        if identity in self._seen:
            return True
        self._seen.add(identity)
        return False


def unrepeated(file: Path, remarks: list[str], repeats: Repeats) -> Iterator[Any]:
    """The records of the next file of a bag, without messages of previous files.

    Messages are in the order of their log times.
    """
    repeats.next_file()
    for record in records_in_log_order(file, remarks):
        if not repeats.repeated(record):
            yield record
