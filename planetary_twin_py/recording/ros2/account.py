"""Received and lost messages, from the sequence numbers of the publishers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field


@dataclass
class TopicAccount:
    """Counts the messages of one topic. Each publisher numbers its messages 1, 2, 3, ...

    A message does not identify its publisher. With several publishers, a number that continues no
    sequence exactly is assigned to the nearest one, unless no message of some publisher has been
    received yet.
    """

    latched: bool = False  # late subscribers receive only the newest: earlier ones are not lost
    recorded: int = 0
    missed: int = 0  # numbers skipped between two received messages
    before: int = 0  # published before the first received message
    reported: int = 0  # losses reported by the middleware; most are among `missed`, too
    _last: list[int] = field(default_factory=list)  # newest number of each publisher

    @property
    def lost(self) -> int:
        """Messages published but not received."""
        return self.missed + (0 if self.latched else self.before)

    def receive(self, number: int, publishers: Callable[[], int] = lambda: 1) -> None:
        """Count a received message.

        Args:
            number: sequence number from its publisher.
            publishers: returns the number of matched publishers; it is called only if needed.
        """
        self.recorded += 1
        last = self._last
        if len(last) == 1 and number - 1 == last[0]:
            last[0] = number
            return
        stream = self._stream(number, publishers)
        if stream is None:
            self._last.append(number)
            self.before += number - 1
        else:
            self.missed += number - self._last[stream] - 1
            self._last[stream] = number

    def _stream(self, number: int, publishers: Callable[[], int]) -> int | None:
        """Index of the sequence that `number` continues; None for a new sequence."""
        if number - 1 in self._last:
            return self._last.index(number - 1)
        earlier = [i for i, last in enumerate(self._last) if last < number]
        if not earlier or len(self._last) < publishers():
            return None
        return max(earlier, key=lambda i: self._last[i])
