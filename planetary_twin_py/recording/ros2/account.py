"""What was received and what was lost, from the numbers publishers give their messages."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field


@dataclass
class TopicAccount:
    """Counts one topic. Each publisher numbers its messages 1, 2, 3, ...

    A message does not say who sent it, so with several publishers a number that continues no
    sequence exactly is taken as the nearest one's, unless a publisher is still unheard.
    """

    latched: bool = False  # a late subscriber gets only the newest: what came before is not lost
    recorded: int = 0
    missed: int = 0  # numbers skipped between two received messages
    before: int = 0  # published before the first received message
    reported: int = 0  # losses the middleware itself told of; most are among `missed` too
    _last: list[int] = field(default_factory=list)  # newest number of each publisher heard

    @property
    def lost(self) -> int:
        """Messages published but not received."""
        return self.missed + (0 if self.latched else self.before)

    def receive(self, number: int, publishers: Callable[[], int] = lambda: 1) -> None:
        """Count a message with its publisher's `number`.

        `publishers` tells how many are matched now; it is asked only where that decides.
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
        """Index of the sequence `number` continues, None where it begins a new one."""
        if number - 1 in self._last:
            return self._last.index(number - 1)
        earlier = [i for i, last in enumerate(self._last) if last < number]
        if not earlier or len(self._last) < publishers():
            return None
        return max(earlier, key=lambda i: self._last[i])
