"""The replay node: publishes what a recording holds, byte for byte, when it was recorded."""

from __future__ import annotations

import itertools
import sys
import time
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Protocol

import rclpy
from rclpy.duration import Duration
from rclpy.logging import get_logger
from rclpy.publisher import Publisher

from planetary_twin_py.recording.rosbag2 import Topic
from planetary_twin_py.recording.tape import Cue, Tape

from .managed import ManagedNode, NodeError, run_node
from .parameters import declare_bounded, declare_fixed
from .playing import Player
from .qos import publisher_qos
from .topics import message_class

# Participants find one another at once, or, where a packet of the first exchange got lost, with the
# next announcement: every 3 s. A subscriber that was there before must not miss the first messages.
_DISCOVERY = 4.0  # [s]
_DELIVERY = 2.0  # [s] longest wait for subscribers to acknowledge the last messages
_LONGEST = 1e7  # [s]
_SHOW_PERIOD = 0.1  # [s]


class Listener(Protocol):
    """Who hears how a replay goes."""

    def say(self, text: str) -> None:
        """A line that stays."""

    def warn(self, text: str) -> None:
        """A line that the user should know of."""

    def move(self, played: float, length: float) -> None:
        """`played` of `length` [s] are over."""


class Replay(ManagedNode):
    """Configure opens the recording, activate plays it, deactivate pauses; it ends by itself."""

    def __init__(
        self, given: Mapping[str, Any] | None = None, listener: Listener | None = None
    ) -> None:
        super().__init__("replay", given)
        self._listener = listener or _Log()
        self._path = declare_fixed(self, "file", "", "recording: an .mcap file or its folder")
        self._rate_factor = declare_bounded(
            self, "rate_factor", 1.0, (0.01, 100.0), "recorded seconds per second [-]"
        )
        self._start = declare_bounded(
            self, "start", 0.0, (0.0, _LONGEST), "recorded time to begin at [s]"
        )
        self._duration = declare_bounded(
            self, "duration", 0.0, (0.0, _LONGEST), "recorded time to play [s]; 0: to the end"
        )
        self._loop = declare_fixed(self, "loop", False, "play again and again")
        self._outlets: dict[str, Publisher] = {}
        self._player: Player | None = None
        self._told = 0
        self._opened = 0.0
        self._length = 0.0
        self._played = 0
        self._shown = 0.0

    def configure(self) -> None:
        """Open the recording and offer its topics."""
        if not self._path:
            raise NodeError("file is not given: -p file:=RECORDING")
        tape = Tape(Path(self._path).expanduser())
        begin, end = self._stretch(tape)
        self._length = (end - begin) * 1e-9
        self._warn_of_damage(tape)
        self._outlets = {name: self._offer(topic) for name, topic in tape.topics.items()}
        self._opened = time.monotonic()
        self._player = Player(self._cues(tape, begin, end), self._rate_factor, self)

    def activate(self) -> None:
        """Begin as soon as subscribers had time to be found, or go on after a pause."""
        self._player.start()

    def deactivate(self) -> None:
        """Pause."""
        self._player.stop()

    def close(self) -> None:
        """Stop, and say how far it came."""
        player, self._player = self._player, None
        if player is None:
            return
        player.stop()
        self._listener.say(
            f"replayed {self._played} messages, at most {player.lateness * 1e3:.1f} ms late"
        )
        for outlet in self._outlets.values():
            self.destroy_publisher(outlet)
        self._outlets = {}

    # Called by the player, in its thread.

    def ready(self) -> bool:
        """Whether every subscriber that was there before has been found."""
        return time.monotonic() - self._opened > _DISCOVERY

    def begin(self) -> None:
        """Say what is played, and who else publishes it."""
        count = len(self._outlets)
        self._listener.say(f"replaying {self._length:.2f} s of {count} topics from {self._path}")
        shared = [name for name in self._outlets if self.count_publishers(name) > 1]
        if shared:
            self._listener.warn(f"others publish too, subscribers hear both: {', '.join(shared)}")

    def play(self, cue: Cue) -> None:
        """Publish a message as it was recorded."""
        self._outlets[cue.topic].publish(cue.data)
        self._played += 1
        now = time.monotonic()
        if now - self._shown > _SHOW_PERIOD:
            self._shown = now
            played = cue.time * 1e-9
            self._listener.move(played % self._length if self._loop else played, self._length)

    def ended(self) -> None:
        """End the process once the last messages are with their subscribers."""
        deadline = time.monotonic() + _DELIVERY
        for outlet in self._outlets.values():
            remaining = max(deadline - time.monotonic(), 0.0)
            outlet.wait_for_all_acked(Duration(seconds=remaining))
        rclpy.try_shutdown(context=self.context)

    def stopped(self, defect: Exception) -> None:
        """End the process with the reason; a publisher refuses once a signal has shut ROS down."""
        if self.context.ok():
            self.fail(f"{self._path}: {type(defect).__name__}: {defect}")

    def _stretch(self, tape: Tape) -> tuple[int, int]:
        """Begin and end [ns] of what is played, after the first message."""
        begin = round(self._start * 1e9)
        if begin > tape.length:
            raise NodeError(
                f"start = {self._start:g}: {self._path} is {tape.length * 1e-9:.3f} s long"
            )
        end = begin + round(self._duration * 1e9) if self._duration else tape.length
        end = min(end, tape.length)
        if self._loop and begin == end:
            raise NodeError(f"loop: what is left of {self._path} has no length")
        return begin, end

    def _cues(self, tape: Tape, begin: int, end: int) -> Iterator[Cue]:
        """What is played, `time` counted from activation."""
        for turn in itertools.count() if self._loop else range(1):
            for cue in tape.cues(begin, end):
                yield cue._replace(time=cue.time - begin + turn * (end - begin))
            self._warn_of_damage(tape)

    def _warn_of_damage(self, tape: Tape) -> None:
        for remark in tape.remarks[self._told :]:
            self._listener.warn(remark)
        self._told = len(tape.remarks)

    def _offer(self, topic: Topic) -> Publisher:
        """A publisher like the recorded ones; raises `NodeError` where that cannot be had."""
        try:
            kind = message_class(topic.type)
            qos = publisher_qos(topic)
        except ImportError:
            raise NodeError(f"{topic.name}: message type {topic.type} is not installed") from None
        except (KeyError, ValueError, TypeError) as defect:
            raise NodeError(f"{topic.name}: recorded QoS is unreadable: {defect!r}") from None
        outlet = self.create_publisher(kind, topic.name, qos)
        if topic.type_hash not in ("", self._type_hash(outlet)):
            raise NodeError(f"{topic.name}: recorded with another version of {topic.type}")
        return outlet

    def _type_hash(self, outlet: Publisher) -> str:
        """Hash of the installed message type, which only the graph tells."""
        own = (self.get_name(), self.get_namespace())
        return next(
            str(info.topic_type_hash)
            for info in self.get_publishers_info_by_topic(outlet.topic_name)
            if (info.node_name, info.node_namespace) == own
        )


class _Log:
    """Tells it in the node's log."""

    # Under a name of its own: a signal has shut down what the node's name would publish to.
    _logger = get_logger("replay")

    def say(self, text: str) -> None:
        self._logger.info(text)

    def warn(self, text: str) -> None:
        self._logger.warning(text)

    def move(self, played: float, length: float) -> None:
        pass


def main(args: list[str] | None = None) -> int:
    """Run the node until the recording has ended."""
    return run_node(Replay, args)


if __name__ == "__main__":
    sys.exit(main())
