"""Follows a measured gearbox in a thread: receives messages and reports estimates."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future
from dataclasses import replace
from queue import Queue
from typing import Protocol

import planetary_twin_py as pt
from planetary_twin_py.following.arrival.bins import closed_by
from planetary_twin_py.following.channels.sampled import MESSAGES
from planetary_twin_py.following.channels.stamp import stamp_of
from planetary_twin_py.following.damage.followed import FollowedDamage
from planetary_twin_py.following.input_error import InputError
from planetary_twin_py.following.measured.messages import Arrived, MessageReader
from planetary_twin_py.following.state import Following

from ..base.damage import SAVED
from .parameters import Followed, FollowerSettings
from .subscriptions import Intake

_SHORTEST, _LONGEST = 0.02, 0.1  # [s] between two polls for messages
_TRANSIT = 0.01  # [s] by which the reading that closes a bin may be later than expected
_DISCOVERY = 0.2  # [s] between two polls for publishers
_JUMP = 1.0  # [s] smallest step of stamps back in time that is a jump
_JUMPED = 5  # successive messages that confirm a jump
_LONGEST_WAIT = 10.0  # [s] longest time in which a request waits for the thread
_COUNTED = 1.0  # [s] between two reports of the damage
_LONGEST_END = 60.0  # [s] longest time to process waiting messages at the end


class FollowerNode(Protocol):
    """Receives the results of the follower, called in its thread."""

    def started(self) -> None:
        """Discard earlier results: the follower restarts."""

    def estimated(self, following: Following) -> None:
        """Publish a new estimate."""

    def refused(self, reason: str) -> None:
        """Report readings that contradict the scene."""

    def jumped(self, seconds: float) -> None:
        """Report stamps that have jumped back by `seconds`."""

    def counted(self, damage: FollowedDamage, *, save: bool) -> None:
        """Publish the damage of the readings so far, and write it if `save`."""

    def stopped(self, defect: Exception) -> None:
        """Report that following has ended."""


class JumpWatch:
    """Recognises stamps of a sender that jump back in time; single late messages are no jump."""

    def __init__(self) -> None:
        self._newest: dict[str, float] = {}
        self._behind: dict[str, int] = {}

    def add(self, one: Arrived) -> float | None:
        """Return by how many seconds the stamps have jumped back, at the last of five messages."""
        stamp = stamp_of(one.message)
        if stamp == 0.0:  # was not set
            return None
        newest = self._newest.setdefault(one.sender, stamp)
        if stamp >= newest - _JUMP:
            self._newest[one.sender] = max(newest, stamp)
            self._behind[one.sender] = 0
            return None
        self._behind[one.sender] = self._behind.get(one.sender, 0) + 1
        if self._behind[one.sender] < _JUMPED:
            return None
        self._newest[one.sender], self._behind[one.sender] = stamp, 0
        return newest - stamp


class Portions:
    """Divides messages where readings may close a bin of `length` [s]: each bin is reported."""

    def __init__(self, length: float) -> None:
        self._length = length
        self._closed: dict[str, int] = {}

    def divide(self, arrived: Sequence[Arrived]) -> Iterator[list[Arrived]]:
        """Yield the messages in their order; only the first of a portion may close bins."""
        portion: list[Arrived] = []
        for one in arrived:
            if one.kind not in MESSAGES and stamp_of(one.message) != 0.0:
                closed = closed_by(stamp_of(one.message), self._length)
                if closed != self._closed.get(one.sender) and portion:
                    yield portion
                    portion = []
                self._closed[one.sender] = closed
            portion.append(one)
        if portion:
            yield portion


class LiveFollower:
    """
    Passes the messages of `source` to a follower and its estimates to `node`.

    The estimates depend on the messages only: not on when the thread runs, and not on how many
    messages it processes at once. On a slow computer the same estimates are published later. Only
    the time without readings is measured by the clock.
    """

    def __init__(
        self, followed: Followed, settings: FollowerSettings, source: Intake, node: FollowerNode
    ) -> None:
        self._followed, self._settings = followed, settings
        self._source, self._node = source, node
        self._begin()
        self.behind = 0.0
        """Time that the last messages waited for this thread [s]."""
        self._advanced = time.monotonic()
        self._stop, self._restart = threading.Event(), threading.Event()
        self._requests: Queue[tuple[Callable[[pt.Follower], None], Future[None]]] = Queue()
        self._thread = threading.Thread(target=self._run, name="follower", daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """Process all received messages, report the last estimate, and end the thread."""
        self._stop.set()
        if self._thread is not threading.current_thread():
            self._thread.join(_LONGEST_END)

    def ask(self, action: Callable[[pt.Follower], None]) -> None:
        """
        Run `action` between two messages, in the thread of the follower; raises what it raises.

        Raises `TimeoutError` if the thread is busy for too long; then `action` never runs.
        """
        request: Future[None] = Future()
        self._requests.put((action, request))
        try:
            request.result(_LONGEST_WAIT)
        except TimeoutError:
            if request.cancel():
                raise TimeoutError("the follower is busy") from None
            request.result()

    def _answer(self) -> None:
        while not self._requests.empty():
            action, request = self._requests.get()
            if not request.set_running_or_notify_cancel():
                continue
            try:
                action(self._follower)
            except Exception as refusal:
                request.set_exception(refusal)
            else:
                request.set_result(None)

    def reset(self) -> None:
        """Restart the follower with the next messages."""
        self._restart.set()

    @property
    def silent(self) -> float:
        """Time since the last new estimate [s]."""
        return time.monotonic() - self._advanced

    @property
    def refusal(self) -> str:
        """Reason why the readings contradict the scene; empty if they do not."""
        return self._refusal

    def _begin(self) -> None:
        self._node.started()
        self._follower = self._followed.follower()
        self.latest: Following = self._follower.estimate()
        """The last reported estimate."""
        self._reader = MessageReader(self._followed.joints, self._followed.scale)
        self._faults: tuple[str, ...] = ()  # of the messages, as last reported
        self._portions = Portions(self._followed.period)
        self._newest = -math.inf  # stamp of the newest estimate, reported or not [s]
        self._due = -math.inf  # stamp of the next one to report [s]
        self._closed = -math.inf  # arrival of the reading that closed the last bin [s]
        self._jumps = JumpWatch()
        self._refusal = ""
        self._stale = True  # there is no estimate yet
        self._count_due, self._save_due = -math.inf, time.monotonic() + SAVED

    def _run(self) -> None:
        try:
            self._follow()
        except Exception as defect:
            self._node.stopped(defect)

    def _follow(self) -> None:
        looked = -math.inf
        while not self._stop.wait(self._idle_time()):
            if time.monotonic() > looked + _DISCOVERY:
                looked = time.monotonic()
                self._source.follow_publishers()
            if self._restart.is_set():
                self._restart.clear()
                self._keep_damage()
                self._begin()
                self._report(self.latest)
            self._answer()
            self._use(self._source.take())
        self._use(self._source.take())
        self._answer()
        if not self._refusal:
            self._checked(self._follower.finish)
            self._report(self._follower.estimate())
        self._keep_damage()

    def _keep_damage(self) -> None:
        """Write the damage of the readings so far, unless they contradict the scene."""
        if not self._refusal and self._follower.damage is not None:
            self._node.counted(self._follower.damage, save=True)

    def _idle_time(self) -> float:
        """
        Return the time until the next poll [s].

        Polls cost more than the readings that they find, so there is one for each bin, when the
        reading that closes it is expected.
        """
        expected = self._closed + self._followed.period + _TRANSIT
        return min(max(expected - time.time(), _SHORTEST), _LONGEST)

    def _use(self, arrived: Sequence[Arrived]) -> None:
        """Process the messages, and report a new estimate."""
        if arrived:
            self.behind = max(time.time() - arrived[0].time, 0.0)
        if self._refusal:
            return
        started, begin = time.monotonic(), 0
        for n, one in enumerate(arrived):
            if (back := self._jumps.add(one)) is None:
                continue
            self._node.jumped(back)
            if self._settings.reset_on_time_jump:
                self._process(arrived[begin:n])
                self._keep_damage()
                self._begin()
                begin = n
        self._process(arrived[begin:])
        now = time.monotonic()
        self._advanced = min(
            self._advanced + now - started, now
        )  # the time for computing does not count as silence
        if not self._stale and now > self._advanced + self._settings.sensor_timeout:
            self._stale = True
            self._report(self._follower.estimate(now=math.inf))

    def _process(self, arrived: Sequence[Arrived]) -> None:
        def process() -> None:
            for portion in self._portions.divide(arrived):
                for block in self._reader.read(portion):
                    self._follower.add(block)
                self._report_what_is_new(portion[0].time)
            if not self._newest > -math.inf and tuple(self._reader.remarks()) != self._faults:
                self._report(self._follower.estimate())  # messages without stamps only

        self._checked(process)

    def _checked(self, step: Callable[[], None]) -> None:
        """Run `step`; readings with a wrong unit, sign or shaft end the following."""
        try:
            step()
        except InputError as fault:
            self._refusal = str(fault)
            self._node.refused(self._refusal)

    def _report_what_is_new(self, arrival: float) -> None:
        """
        Report an estimate whenever the stamps have advanced by the publishing period.

        `arrival` is that of the reading that may have closed a bin [s].
        """
        now = self._follower.time
        if not now > self._newest:
            return
        self._newest, self._closed = now, arrival
        self._advanced, self._stale = time.monotonic(), False
        if now >= self._due:
            self._due = now + 1.0 / self._settings.publish_rate - 0.5 * self._followed.period
            self._report(self._follower.estimate())
        self._count(now)

    def _count(self, now: float) -> None:
        """Report the damage once in a second of the stamps, of which `now` is the last [s]."""
        damage = self._follower.damage
        if damage is None or now < self._count_due:
            return
        self._count_due = now + _COUNTED - 0.5 * self._followed.period
        save = time.monotonic() >= self._save_due
        if save:
            self._save_due = time.monotonic() + SAVED
        self._node.counted(damage, save=save)

    def _report(self, estimate: Following) -> None:
        self._faults = tuple(self._reader.remarks())
        estimate = replace(estimate, remarks=(*estimate.remarks, *self._faults))
        self.latest = estimate
        self._node.estimated(estimate)
