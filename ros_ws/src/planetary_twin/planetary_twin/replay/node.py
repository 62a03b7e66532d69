"""The replay node: publishes the messages of a recording, byte for byte, in recorded time."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rcl_interfaces.msg import SetParametersResult
from rclpy.logging import get_logger
from rclpy.parameter import Parameter

from planetary_twin_py.recording.ros2.clock_messages import CLOCK, with_clock
from planetary_twin_py.recording.ros2.playback import Playback, TimedMessage
from planetary_twin_py.recording.ros2.renaming import moved

from ..base.lifecycle_node import ManagedNode, NodeError, shut_down
from ..base.parameters import AT_ONCE, declare_settings, setting, settings_of
from ..base.rate_factor import FASTEST, SLOWEST, UNLIMITED, check_rate_factor
from ..base.spin import run_node
from .player import DISCOVERY, Excerpt, Player
from .publishers import Outlets
from .services import serve_playing

# Longest wait for subscribers to acknowledge the last messages; one that was killed never does.
_DELIVERY = 30.0  # [s]
_LONGEST = 1e7  # [s]
_RATE = "rate_factor"


@dataclass(frozen=True)
class ReplaySettings:
    """What to play, and how; all but the rate may change until the node is configured."""

    file: str = setting("", "recording: an .mcap file or its folder")
    rate_factor: float = setting(
        1.0,
        f"recorded seconds per second, {SLOWEST:g} to {FASTEST:g}; 0: no limit [-]",
        (UNLIMITED, FASTEST),
        AT_ONCE,
    )
    start: float = setting(0.0, "recorded time at the start [s]", (0.0, _LONGEST))
    duration: float = setting(0.0, "recorded time to play [s]; 0: to the end", (0.0, _LONGEST))
    loop: bool = setting(False, "repeat until stopped")
    start_paused: bool = setting(False, "start paused")
    clock: float = setting(0.0, "/clock messages per recorded second [Hz]; 0: none", (0.0, 1000.0))
    namespace: str = setting("", "replaces the recorded namespace; empty: as recorded")
    topics: Sequence[str] = setting([""], "recorded topics to play; empty: all")


class Display:
    """Shows the messages of a replay in the log; a subclass may show its position, too."""

    # Not the node's logger: after a signal, it can no longer publish to /rosout.
    _logger = get_logger("replay")

    def say(self, text: str) -> None:
        """Show a line."""
        self._logger.info(text)

    def warn(self, text: str) -> None:
        """Show a warning."""
        self._logger.warning(text)

    def move(self, instant: float, end: float) -> None:
        """Show the position `instant` [s] in the recording, which is played to `end` [s]."""


class Replay(ManagedNode):
    """
    Publishes a recording.

    `configure` opens the recording, `activate` plays it, `deactivate` stops it. The node ends with
    the recording.

    `given` contains start values of parameters. `display` shows messages and the position, by
    default in the node's log.
    """

    # From `configure` on:
    _playback: Playback
    _outlets: Outlets

    def __init__(
        self, given: Mapping[str, Any] | None = None, display: Display | None = None
    ) -> None:
        super().__init__("replay", given)
        self._display = display or Display()
        declare_settings(self, ReplaySettings)
        self._given = settings_of(self, ReplaySettings)
        check_rate_factor(self._given.rate_factor)
        self.add_on_set_parameters_callback(self._validate)
        self.add_post_set_parameters_callback(self._submit)
        self._player: Player | None = None
        self._active = False
        self._begin = self._end = 0  # [ns]
        self._warned = 0  # number of damages
        serve_playing(self, self._playing, self._stamp)

    def configure(self) -> None:
        """Open the recording and create its publishers."""
        given = self._given = settings_of(self, ReplaySettings)
        if not given.file:
            raise NodeError("file is not given: -p file:=RECORDING")
        chosen = [topic for topic in given.topics if topic]
        playback = self._playback = Playback(Path(given.file).expanduser(), chosen)
        self._warned = 0
        self._warn_of_damage()
        self._begin, self._end = self._excerpt(playback)
        # A bag may contain topics without messages, whose types may not be installed here.
        topics = {name: topic for name, topic in playback.topics.items() if playback.counts[name]}
        ticking = given.clock > 0.0 and CLOCK.name not in topics
        if ticking:
            topics[CLOCK.name] = CLOCK
        elif given.clock:
            self._display.warn(
                f"clock = {given.clock:g}: {given.file} contains /clock, which is played"
            )
        own = {name: name for name in topics}
        names = moved(topics, given.namespace) if given.namespace else own
        outlets = self._outlets = Outlets(self, topics.values(), names)
        excerpt = Excerpt(
            self._begin,
            self._end,
            given.loop,
            lambda begin: self._messages(playback, begin, ticking),
        )
        callbacks = self._show, self._announce, self._finish
        self._player = Player(excerpt, given.start_paused, outlets, *callbacks)

    def activate(self) -> None:
        """Start after the time for discovery, or continue."""
        player = self._configured_player()
        if not player.ready:
            self._display.say(f"waiting {DISCOVERY:g} s for subscribers")
        player.start(self.get_parameter(_RATE).value)
        self._active = True

    def deactivate(self) -> None:
        """Stop before the next message."""
        self._active = False
        self._configured_player().stop()

    def close(self) -> None:
        """Stop, and report the number of messages."""
        player, self._player = self._player, None
        if player is None:
            return
        self._active = False
        player.stop()
        self._display.say(
            f"replayed {player.played} messages, at most {player.lateness * 1e3:.1f} ms late"
        )

    # Called by the player, in its thread.

    def _announce(self) -> None:
        """Report what is played, and topics that have other publishers."""
        length = (self._end - self._begin) * 1e-9
        self._display.say(
            f"replaying {length:.2f} s of {len(self._outlets)} topics from {self._given.file}"
        )
        if shared := self._outlets.shared():
            self._display.warn(
                f"other publishers exist, subscribers receive both: {', '.join(shared)}"
            )

    def _show(self, instant: int) -> None:
        self._display.move(instant * 1e-9, self._end * 1e-9)

    def _finish(self, defect: Exception | None) -> None:
        """End the process once the last messages are acknowledged, or with the reason."""
        if defect is None:
            self._outlets.wait(_DELIVERY)
            shut_down(self.context)
        elif self.context.ok():
            self.fail(f"{self._given.file}: {type(defect).__name__}: {defect}")

    def _playing(self) -> Player:
        """Return the player."""
        if not self._active:
            raise ValueError("the replay is not active")
        return self._configured_player()

    def _configured_player(self) -> Player:
        if self._player is None:
            raise NodeError("no recording is open: configure the node first")
        return self._player

    def _stamp(self, instant: float) -> int:
        """Return the recorder's time [ns] of a recorded instant [s]."""
        return self._playback.start + round(instant * 1e9)

    def _validate(self, parameters: list[Parameter]) -> SetParametersResult:
        try:
            for value in (p.value for p in parameters if p.name == _RATE):
                check_rate_factor(value)
        except ValueError as refusal:
            return SetParametersResult(successful=False, reason=str(refusal))
        return SetParametersResult(successful=True)

    def _submit(self, parameters: list[Parameter]) -> None:
        for value in (p.value for p in parameters if p.name == _RATE):
            if self._active:
                self._configured_player().set_rate(value)

    def _excerpt(self, playback: Playback) -> tuple[int, int]:
        """Return start and end [ns] of the part to play, after the first message."""
        given = self._given
        begin = round(given.start * 1e9)
        if begin > playback.length:
            length = playback.length * 1e-9
            raise NodeError(f"start = {given.start:g}: {given.file} is {length:.3f} s long")
        end = begin + round(given.duration * 1e9) if given.duration else playback.length
        end = min(end, playback.length)
        if given.loop and begin == end:
            raise NodeError(f"loop: the part of {given.file} to play has no length")
        return begin, end

    def _messages(self, playback: Playback, begin: int, ticking: bool) -> Iterator[TimedMessage]:
        if ticking:
            yield from with_clock(playback, begin, self._end, self._given.clock)
        else:
            yield from playback.messages(begin, self._end)
        self._warn_of_damage()

    def _warn_of_damage(self) -> None:
        remarks, warned = self._playback.remarks, self._warned
        for remark in remarks[warned:]:
            self._display.warn(remark)
        self._warned = len(remarks)


def main(args: list[str] | None = None) -> int:
    """Run the node until the recording ends; returns the exit code."""
    return run_node(Replay, args)
