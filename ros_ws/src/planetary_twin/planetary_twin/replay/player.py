"""Plays the messages of a recording at their instants in a separate thread."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Future
from typing import NamedTuple

from planetary_twin_py.recording.ros2.playback import TimedMessage
from planetary_twin_py.recording.ros2.transport import Transport

from ..base.command_queue import CommandQueue
from .publishers import Outlets

LONGEST_STEP = 10.0  # [s] recorded time of one step of a paused replay
# Participants discover each other at once, or, if a packet of the first exchange was lost, at the
# next announcement: every 3 s. An existing subscriber must not miss the first messages.
DISCOVERY = 4.0  # [s]
_SHOW_PERIOD = 0.1  # [s]
_YIELD = 2e-3  # [s] for subscribers to acknowledge messages
_LONGEST_WAIT = 3600.0  # [s] for a command, while there is nothing to play


class Excerpt(NamedTuple):
    """
    The part of a recording that is played, from `begin` to `end` [ns], repeatedly if `loop`.

    `messages` yields those from an instant [ns] to `end`. A seek may go to any instant before it.
    """

    begin: int
    end: int
    loop: bool
    messages: Callable[[int], Iterator[TimedMessage]]


class Player:
    """
    Plays a part of a recording at absolute deadlines on the steady clock.

    If the rate factor is 0, it plays as fast as reliable subscribers acknowledge. A late message
    is played at once and none is skipped, so the player catches up after a delay. If it is paused
    at an instant, all messages up to and at that instant have been played. Commands are executed
    between two messages; their futures return the recorded instant [s].

    `paused` is the state at the start. `outlets` publish the messages; `show` gets an instant [ns]
    ten times a second. `started` is called before the first message, `ended` after the last one,
    or with the exception that ended the thread.
    """

    def __init__(
        self,
        excerpt: Excerpt,
        paused: bool,
        outlets: Outlets,
        show: Callable[[int], None],
        started: Callable[[], None],
        ended: Callable[[Exception | None], None],
    ) -> None:
        self._excerpt, self._outlets = excerpt, outlets
        self._show, self._started, self._ended = show, started, ended
        self._paused = paused
        self._open = time.monotonic() + DISCOVERY
        self._shown = 0.0
        self.played = 0
        """Number of messages."""
        self._transport = Transport(excerpt.begin)
        self._commands = CommandQueue(self._set)
        self._messages: Iterator[TimedMessage] = iter(())
        self._loaded = False
        self._next: TimedMessage | None = None
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None
        self.lateness = 0.0
        """Longest delay of a message [s]."""

    @property
    def ready(self) -> bool:
        """Whether the time for discovery is over."""
        return time.monotonic() > self._open

    def start(self, rate_factor: float) -> None:
        """Start after the time for discovery, or continue after `stop`."""
        self._stop.clear()
        self._transport.set_rate(rate_factor, time.monotonic(), self._upcoming)
        self._thread = threading.Thread(target=self._run, name="playback", daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """Stop before the next message."""
        self._stop.set()
        self._commands.put(lambda: 0.0)  # wakes the thread
        if self._thread is not None:
            self._thread.join()

    def pause(self, paused: bool) -> Future[float]:
        """Pause the replay, or resume it."""
        return self._commands.put(lambda: self._pause(paused))

    def step(self, duration: float) -> Future[float]:
        """Play `duration` [s] of a paused replay, as fast as possible."""
        return self._commands.put(lambda: self._step(duration))

    def seek(self, time: float) -> Future[float]:
        """Continue at `time` [s] after the first message."""
        return self._commands.put(lambda: self._seek(time))

    def set_rate(self, rate_factor: float) -> Future[float]:
        """Continue at another rate."""
        return self._commands.change({"rate_factor": rate_factor})

    def _run(self) -> None:
        try:
            if self._stop.wait(max(self._open - time.monotonic(), 0.0)):
                return
            if not self._loaded:
                self._started()
                self._go_to(self._excerpt.begin)
            if not self._paused:
                self._transport.resume(time.monotonic())
            if self._play_to_end():
                self._ended(None)
        except Exception as defect:
            self._ended(defect)
        finally:
            self._transport.pause(time.monotonic(), self._upcoming)
            self._commands.refuse("the replay has stopped")

    def _play_to_end(self) -> bool:
        """Return False if stopped before."""
        while not self._stop.is_set():
            remaining = self._transport.remaining(self._upcoming, time.monotonic())
            if not self._transport.paced and not self._has_room():
                remaining = max(remaining, _YIELD)
            # Wait for a command instead of sleeping, so that it takes effect at once.
            answers = self._commands.execute(min(max(remaining, 0.0), _LONGEST_WAIT))
            for answer in answers:
                answer()
            if answers or remaining > 0.0:
                continue
            if self._next is not None:
                self.lateness = max(self.lateness, -remaining)
                self._play(self._next)
            elif self._excerpt.loop:
                self._transport.shift(self._excerpt.begin - self._excerpt.end)
                self._load(self._excerpt.begin)
            else:
                return True
        return False

    @property
    def _upcoming(self) -> int:
        """Instant of the next message, or the end [ns]."""
        return self._next.time if self._next is not None else self._excerpt.end

    def _load(self, instant: int) -> None:
        self._messages, self._loaded = self._excerpt.messages(instant), True
        self._next = next(self._messages, None)

    def _has_room(self) -> bool:
        return self._next is None or self._outlets.has_room(self._next)

    def _play(self, message: TimedMessage) -> None:
        self._outlets.publish(message)
        self.played += 1
        if (now := time.monotonic()) > self._shown + _SHOW_PERIOD:
            self._shown = now
            self._show(message.time)
        self._next = next(self._messages, None)

    def _play_through(self, instant: int) -> None:
        """Play all messages up to and at `instant`, unless stopped, and set the position to it."""
        while self._next is not None and self._next.time <= instant and not self._stop.is_set():
            if self._has_room():
                self._play(self._next)
            else:
                self._stop.wait(_YIELD)
        self._transport.place(min(instant, self._upcoming), time.monotonic())

    def _go_to(self, instant: int) -> None:
        """Set the position to `instant`, after publishing the messages latched there."""
        self._load(instant)
        self._play_through(instant)

    # Commands.

    def _pause(self, paused: bool) -> float:
        self._paused = paused
        now = time.monotonic()
        instant = self._transport.position(now, self._upcoming)
        if paused:
            self._transport.pause(now, instant)
            self._play_through(instant)
        else:
            self._transport.resume(now)
        return instant * 1e-9

    def _step(self, duration: float) -> float:
        if not self._paused:
            raise ValueError(f"duration = {duration:g} s: the replay runs; pause it first")
        if not 0.0 < duration <= LONGEST_STEP:
            raise ValueError(
                f"duration = {duration:g} s: must be above 0 and at most {LONGEST_STEP:g}"
            )
        begin, end, loop, _ = self._excerpt
        target = self._transport.position(time.monotonic(), self._upcoming)
        target += round(duration * 1e9)
        while loop and target > end:
            self._play_through(end)
            target -= end - begin
            self._load(begin)
        target = min(target, end)
        self._play_through(target)
        return target * 1e-9

    def _seek(self, instant: float) -> float:
        end = self._excerpt.end * 1e-9
        if not 0.0 <= instant <= end:
            raise ValueError(f"time = {instant:g} s: must be within 0 and {end:.9g}")
        self._go_to(round(instant * 1e9))
        return instant

    def _set(self, values: Mapping[str, float]) -> float:
        now = time.monotonic()
        instant = self._transport.position(now, self._upcoming)
        self._transport.set_rate(values["rate_factor"], now, instant)
        return instant * 1e-9
