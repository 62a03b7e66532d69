"""Ring buffer of the messages of the last seconds, for snapshots."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from functools import partial

from .account import TopicAccount
from .bag import BagWriter
from .latched import Latched, Serialised
from .metadata import Topic


class Ring:
    """Buffer with the interface of `BagWriter` that drops messages older than `duration` [s].

    The newest messages of latched topics are kept regardless of their age.
    """

    def __init__(self, duration: float) -> None:
        self.size = 0
        """Bytes of the messages in memory."""
        self._duration = round(duration * 1e9)
        self._topics: list[Topic] = []  # of channels 1, 2, 3, ...
        self._attached: dict[str, tuple[bytes, str]] = {}
        self._messages: deque[Serialised] = deque()
        self._latched = Latched()  # of dropped messages

    def attach(self, name: str, data: bytes, media_type: str) -> None:
        """Keep an attachment."""
        self._attached[name] = data, media_type

    def add_topic(self, topic: Topic, account: TopicAccount) -> int:
        """Open a channel; return its number, for `write`.

        A snapshot has its own counts, so `account` is not written.
        """
        self._topics.append(topic)
        channel = len(self._topics)
        self._latched.add_topic(channel, topic)
        return channel

    def write(
        self, channel: int, data: bytes, log_time: int, publish_time: int, sequence: int
    ) -> None:
        """Keep a serialised message, and drop those that are too old."""
        messages = self._messages
        messages.append(Serialised(channel, data, log_time, publish_time, sequence))
        self.size += len(data)
        while messages[0].log_time < log_time - self._duration:
            dropped = messages.popleft()
            self.size -= len(dropped.data)
            if dropped.channel in self._latched:
                self._latched.keep(dropped)

    def flush(self) -> None:
        """Do nothing: messages are in memory only."""

    def write_to(self, bag: BagWriter) -> None:
        """Write the buffered messages to `bag`."""
        for name, content in self._attached.items():
            bag.attach(name, *content)
        # Messages before the window do not count as lost.
        accounts = [TopicAccount(latched=True) for _ in self._topics]
        channels = [bag.add_topic(*pair) for pair in zip(self._topics, accounts, strict=True)]
        for message in self._window():
            channel_index = message.channel - 1
            bag.write(channels[channel_index], *message[1:])
            publishers = partial(len, self._topics[channel_index].offered_qos)
            accounts[channel_index].receive(message.sequence, publishers)

    def _window(self) -> Iterator[Serialised]:
        """Latched messages that are valid at the start of the window, then the window."""
        begin = self._messages[0].log_time if self._messages else 0
        for message in self._latched:
            yield message._replace(log_time=max(message.log_time, begin))
        yield from self._messages
