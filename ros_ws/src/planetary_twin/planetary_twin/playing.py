"""Plays the cues of a tape at their instants, in a thread of its own, and takes orders."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Future
from typing import NamedTuple, Protocol

from planetary_twin_py.recording.ros2.tape import Cue
from planetary_twin_py.recording.ros2.transport import Transport

from .orders import Orders

LONGEST_STEP = 10.0  # [s] that a paused tape plays at a time
_POLL = 0.05  # [s]
_YIELD = 2e-3  # [s] for subscribers to take what they were sent
_LONGEST_WAIT = 3600.0  # [s] for an order, while there is nothing to play


class Stage(Protocol):
    """Where cues are played; called in the player's thread."""

    def ready(self) -> bool:
        """Whether the first cue may come."""

    def begin(self) -> None:
        """Begin anew: the first cue comes next."""

    def has_room(self, cue: Cue) -> bool:
        """Return whether `cue` can be played without loss to a subscriber that is slow."""

    def play(self, cue: Cue) -> None:
        """Publish `cue`, whose instant is now."""

    def ended(self) -> None:
        """There is no further cue."""

    def stopped(self, defect: Exception) -> None:
        """Hear that the thread ends because of `defect`."""


class Stretch(NamedTuple):
    """
    What of a tape is played: from `begin` to `end` [ns], and from `begin` again if it loops.

    `cues` gives those from an instant to `end`. Anything up to `end` can be sought.
    """

    begin: int
    end: int
    loop: bool
    cues: Callable[[int], Iterator[Cue]]


class Player:
    """
    Plays so many recorded seconds per second, to absolute deadlines on the steady clock.

    Where the rate factor is 0, it plays as fast as reliable subscribers take what they are sent.
    A cue that is late is played at once and none is left out: the tape catches up by itself. Where
    it is paused at an instant, all up to and at that instant has been played. Orders are carried
    out between two cues; their futures give the recorded instant [s] of that.
    """

    def __init__(self, stretch: Stretch, paused: bool, stage: Stage) -> None:
        self._stretch = stretch
        self._stage = stage
        self._paused = paused
        self._transport = Transport(stretch.begin)
        self._orders = Orders(self._set)
        self._cues: Iterator[Cue] | None = None
        self._next: Cue | None = None
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None
        self.lateness = 0.0
        """The longest that a cue came after its instant [s]."""

    def start(self, rate_factor: float) -> None:
        """Begin as soon as the stage is ready, or go on where `stop` left off."""
        self._stop.clear()
        self._transport.set_rate(rate_factor, time.monotonic(), self._upcoming)
        self._thread = threading.Thread(target=self._run, name="tape", daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """Hold before the next cue."""
        self._stop.set()
        self._orders.give(lambda: 0.0)  # wakes the thread
        if self._thread is not None:
            self._thread.join()

    def pause(self, paused: bool) -> Future[float]:
        """Have the tape stand still, or go on."""
        return self._orders.give(lambda: self._pause(paused))

    def step(self, duration: float) -> Future[float]:
        """Have a paused tape play `duration` [s], as fast as it goes."""
        return self._orders.give(lambda: self._step(duration))

    def seek(self, time: float) -> Future[float]:
        """Have the tape go on at `time` [s]."""
        return self._orders.give(lambda: self._seek(time))

    def set_rate(self, rate_factor: float) -> Future[float]:
        """Have the tape go on at another rate."""
        return self._orders.change({"rate_factor": rate_factor})

    def _run(self) -> None:
        try:
            while not self._stage.ready():
                if self._stop.wait(_POLL):
                    return
            if self._cues is None:
                self._stage.begin()
                self._go_to(self._stretch.begin)
            if not self._paused:
                self._transport.go(time.monotonic())
            if self._play():
                self._stage.ended()
        except Exception as defect:
            self._stage.stopped(defect)
        finally:
            self._transport.hold(time.monotonic(), self._upcoming)
            self._orders.refuse("the replay has stopped")

    def _play(self) -> bool:
        """Play to the end; false if stopped before."""
        while not self._stop.is_set():
            remaining = self._transport.remaining(self._upcoming, time.monotonic())
            if not self._transport.paced and not self._has_room():
                remaining = max(remaining, _YIELD)
            # Waiting for an order, not sleeping: neither it nor a signal waits for the next cue.
            answers = self._orders.carry_out(min(max(remaining, 0.0), _LONGEST_WAIT))
            for answer in answers:
                answer()
            if answers or remaining > 0.0:
                continue
            if self._next is not None:
                self.lateness = max(self.lateness, -remaining)
                self._play_next()
            elif self._stretch.loop:
                self._transport.shift(self._stretch.begin - self._stretch.end)
                self._load(self._stretch.begin)
            else:
                return True
        return False

    @property
    def _upcoming(self) -> int:
        """Instant of what comes next [ns]."""
        return self._next.time if self._next is not None else self._stretch.end

    def _load(self, instant: int) -> None:
        self._cues = self._stretch.cues(instant)
        self._next = next(self._cues, None)

    def _has_room(self) -> bool:
        return self._next is None or self._stage.has_room(self._next)

    def _play_next(self) -> None:
        self._stage.play(self._next)
        self._next = next(self._cues, None)

    def _play_through(self, instant: int) -> None:
        """Play all up to and at `instant`, and stand there; less far if stopped meanwhile."""
        while self._next is not None and self._next.time <= instant and not self._stop.is_set():
            if self._has_room():
                self._play_next()
            else:
                self._stop.wait(_YIELD)
        self._transport.place(min(instant, self._upcoming), time.monotonic())

    def _go_to(self, instant: int) -> None:
        """Stand at `instant`, with what is latched there."""
        self._load(instant)
        self._play_through(instant)

    # Orders.

    def _pause(self, paused: bool) -> float:
        self._paused = paused
        now = time.monotonic()
        instant = self._transport.position(now, self._upcoming)
        if paused:
            self._transport.hold(now, instant)
            self._play_through(instant)
        else:
            self._transport.go(now)
        return instant * 1e-9

    def _step(self, duration: float) -> float:
        if not self._paused:
            raise ValueError(f"duration = {duration:g} s: the replay runs; pause it first")
        if not 0.0 < duration <= LONGEST_STEP:
            raise ValueError(
                f"duration = {duration:g} s: must be above 0 and at most {LONGEST_STEP:g}"
            )
        begin, end, loop, _ = self._stretch
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
        end = self._stretch.end * 1e-9
        if not 0.0 <= instant <= end:
            raise ValueError(f"time = {instant:g} s: must be within 0 and {end:.9g}")
        self._go_to(round(instant * 1e9))
        return instant

    def _set(self, values: Mapping[str, float]) -> float:
        now = time.monotonic()
        instant = self._transport.position(now, self._upcoming)
        self._transport.set_rate(values["rate_factor"], now, instant)
        return instant * 1e-9
