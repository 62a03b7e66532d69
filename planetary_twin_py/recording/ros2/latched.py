"""The messages that a late subscriber receives: the newest ones of latched topics."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from typing import NamedTuple

from .metadata import Topic


class Serialised(NamedTuple):
    """A message of a channel, received at `log_time` and sent at `publish_time` [ns]."""

    channel: int
    data: bytes
    log_time: int
    publish_time: int
    sequence: int


class Latched:
    """Keeps as many messages of each latched topic as its publishers."""

    def __init__(self) -> None:
        self._kept: dict[int, deque[Serialised]] = {}

    def __contains__(self, channel: int) -> bool:
        return channel in self._kept

    def __iter__(self) -> Iterator[Serialised]:
        return iter(sorted(self._all(), key=lambda message: message.log_time))

    def add_topic(self, channel: int, topic: Topic) -> None:
        """Keep messages of `channel` if its topic is latched."""
        if topic.kept:
            self._kept[channel] = deque(maxlen=topic.kept)

    def keep(self, message: Serialised) -> None:
        """Keep `message` of a latched topic, in place of the oldest one."""
        self._kept[message.channel].append(message)

    def _all(self) -> Iterator[Serialised]:
        for kept in self._kept.values():
            yield from kept
