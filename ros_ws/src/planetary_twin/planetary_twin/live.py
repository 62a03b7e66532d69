"""Runs a twin in real time, in a thread of its own, and gives it orders between two intervals."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from enum import StrEnum
from typing import NamedTuple, Protocol

from planetary_twin_py import OperatingPoint, Twin, Window
from planetary_twin_py.quality_control import QualityControl, Setting
from planetary_twin_py.runaway import RunawayError

from .hold import Hold
from .orders import Orders
from .pacing import Pace
from .ramps import Ramps

LONGEST_STEP = 10.0  # [s] that a paused twin makes at a time
_ALERTNESS = 0.1  # [s] after which a paused twin looks whether it is to end
_POLL = 2e-3  # [s] after which a twin looks again whether its recorder has caught up


class Listener(Protocol):
    """What hears of a live twin; called in its thread."""

    def prepare(self, window: Window) -> None:
        """Take an interval that has been computed; its wall instant is still to come."""

    def publish(self) -> None:
        """Publish the prepared interval, whose end is at this wall instant."""

    def changed(self, point: OperatingPoint, instant: float) -> None:
        """Take the operating point in force from simulated time `instant` [s] on."""

    def refused(self, reason: str) -> None:
        """Hear why what was on its way to new values stays where it is."""

    def retuned(self, instant: float, before: Setting, quality: QualityControl) -> None:
        """From simulated time `instant` [s] on, `quality` sets what `before` did."""

    def ready(self) -> bool:
        """Whether time can pass: what it waits for is there, such as a clock to follow."""

    def has_room(self) -> bool:
        """Whether the recorder has kept up, so that the next interval may be published."""

    def goes_on(self, twin: Twin) -> None:
        """At the start, after a stop, and while time stands: the present time of `twin` is now."""

    def stopped(self, defect: Exception) -> None:
        """Hear that the thread ends because of `defect`."""


class State(StrEnum):
    """Of simulated time."""

    RUNNING = "running"
    PAUSED = "paused"
    WAITING = "waits"
    FAILED = "failed"


class Progress(NamedTuple):
    """Where a live twin stands, taken at the end of an interval."""

    simulated: float  # [s]
    wall: float  # [s] steady clock
    ran: float  # [s] simulated by intervals, one after another
    lasted: float  # [s] of wall time that these took; none passes while time stands
    cpu: float  # [s] processor time of the thread
    overruns: int
    repeats: bool  # steady running, which is not computed again
    state: State
    failure: str = ""  # why it has failed
    held: float = 0.0  # [s] of wall time that the twin has waited for its recorder


class LiveTwin:
    """
    Advances `twin` by `interval` [s] at a time.

    It makes `rate_factor` simulated seconds per second, or as fast as it goes where that is 0.
    `quality` chooses the setting, and may be replaced at any time, from any thread. Orders
    are carried out between two intervals; their futures give the simulated instant [s] of that.

    Above real time and in steps it waits for its recorder; at real time and below it never does.
    """

    def __init__(
        self,
        twin: Twin,
        interval: float,
        rate_factor: float,
        quality: QualityControl,
        listener: Listener,
    ) -> None:
        self._twin = twin
        self._interval = interval
        self._stop = threading.Event()
        self._pace = Pace(interval / rate_factor if rate_factor else 0.0, self._stop.wait)
        self._hold = Hold(lambda: 0.0 < rate_factor <= 1.0 or listener.has_room())
        self.quality = quality
        self._listener = listener
        self._orders = Orders(self._set)
        self._ramps = Ramps()
        self._paused = False
        self._failure = ""  # why the twin stays where it is until a restart
        self._stands = True
        self._untold = True  # an operating point that is in force
        self._thread = threading.Thread(target=self._run, name="twin", daemon=True)
        self._repeated = False
        self._ran = self._lasted = self._mark = 0.0  # see `Progress`; where the last one ended
        self.progress = self._standing()

    def start(self) -> Progress:
        """Begin at the twin's present time; returns where that is."""
        begun = self.progress = self._standing()._replace(cpu=0.0)
        self._thread.start()
        return begun

    def stop(self) -> None:
        """End after the interval in progress, which is still published, if need be early."""
        self._stop.set()
        self._thread.join()

    def submit(self, values: Mapping[str, float]) -> Future[float]:
        """Have `values` of the operating point set."""
        return self._orders.change(values)

    def ramp(self, values: Mapping[str, float], duration: float) -> Future[float]:
        """Have `values` of the operating point reached in `duration` [s], interval by interval."""
        return self._orders.give(lambda: self._ramp(values, duration))

    def pause(self, paused: bool) -> Future[float]:
        """Have simulated time stand still, or go on."""
        return self._orders.give(lambda: self._pause(paused))

    def step(self, duration: float) -> Future[float]:
        """Have a paused twin make `duration` [s], as fast as it goes."""
        return self._orders.give(lambda: self._step(duration))

    def restart(self, twin: Twin) -> Future[float]:
        """Have another twin take the place of this one."""
        return self._orders.give(lambda: self._restart(twin))

    def _run(self) -> None:
        try:
            while not self._stop.is_set():
                answers = self._orders.carry_out(self._patience())
                stood, self._stands = self._stands, self._halted()
                if stood and not self._stands:
                    self._listener.goes_on(self._twin)
                    self._pace.start()
                    self._mark = time.monotonic()
                going = not (self._stands or self._hold.active)
                if going:
                    self._follow_ramps()
                self._announce()
                if answers:  # who asked may look at once where it stands
                    self.progress = self._standing()
                for answer in answers:
                    answer()
                if going and self._pass(self._interval, self._pace.wait):
                    before, self._mark = self._mark, time.monotonic()
                    self._ran += self._interval
                    self._lasted += self._mark - before
                self.progress = self._standing()
        except Exception as defect:
            self._listener.stopped(defect)
        finally:
            self._orders.refuse("the simulation has stopped")

    def _announce(self) -> None:
        """Tell the operating point once for each instant from which there is another."""
        if self._untold and self._listener.ready():
            self._untold = False
            if self._stands:
                self._listener.goes_on(self._twin)
            self._listener.changed(self._twin.operating_point, self._twin.time)

    def _pass(self, duration: float, wait: Callable[[], None]) -> bool:
        """
        Compute one interval, and publish it after `wait`; returns whether the twin could.

        The setting is that of the quality control so far; only the wait costs nothing.
        """
        quality = self.quality
        self._tune(quality)
        begin, idle = time.monotonic(), time.thread_time()
        try:
            window = self._twin.advance(duration)
        except RunawayError as reason:  # nothing of the interval is published
            self._failure = str(reason)
            return False
        self._listener.prepare(window)
        prepared = time.monotonic()
        wait()
        waited = time.monotonic() - prepared
        self._listener.publish()
        work = time.thread_time() - idle
        quality.observe(time.monotonic() - begin - waited, work, window.repeated)
        self._repeated = window.repeated
        return True

    def _tune(self, quality: QualityControl) -> None:
        twin, setting = self._twin, quality.setting
        before = Setting(twin.tolerance, twin.sample_rate)
        if setting != before:
            twin.set_tolerance(setting.tolerance)
            instant = twin.set_sample_rate(setting.sample_rate)
            self._listener.retuned(instant, before, quality)

    def _set(self, values: Mapping[str, float]) -> float:
        self._ramps.leave(values)
        return self._change(values)

    def _change(self, values: Mapping[str, float]) -> float:
        self._refuse_after_failure()
        instant = self._twin.set(**values)
        self.quality.relearn()
        self._untold = True
        return instant

    def _ramp(self, values: Mapping[str, float], duration: float) -> float:
        self._refuse_after_failure()
        point = self._twin.operating_point
        first = {name: getattr(point, name) for name in values}
        self._ramps.start(self._twin.time, duration, first, values)
        return self._twin.time

    def _follow_ramps(self) -> None:
        """Set what is on its way to where it is at the end of the interval to come."""
        values = self._ramps.values(self._twin.time + self._interval)
        if not values:
            return
        try:
            self._change(values)
        except ValueError as refusal:  # the twin keeps its last good state
            self._ramps.clear()
            self._listener.refused(str(refusal))

    def _refuse_after_failure(self) -> None:
        if self._failure:
            raise ValueError(f"{self._failure}; ~/reset starts a new run with the parameters")

    def _pause(self, paused: bool) -> float:
        self._refuse_after_failure()
        self._paused = paused
        return self._twin.time

    def _step(self, duration: float) -> float:
        self._refuse_after_failure()
        if not self._paused:
            raise ValueError(f"duration = {duration:g} s: the twin runs; pause it first")
        if not 0.0 < duration <= LONGEST_STEP:
            raise ValueError(
                f"duration = {duration:g} s: must be above 0 and at most {LONGEST_STEP:g}"
            )
        self._listener.goes_on(self._twin)
        count = math.ceil(duration / self._interval - 1e-9)
        for n in range(count):
            left = duration - n * self._interval
            self._follow_ramps()
            self._announce()
            self._wait_for_room()
            self._pass(min(self._interval, left), lambda: None)
            self.progress = self._standing()
            self._refuse_after_failure()
        return self._twin.time

    def _wait_for_room(self) -> None:
        """Wait until the recorder has kept up; steps go as fast as they can."""
        while not self._listener.has_room():
            if self._stop.wait(_POLL):
                raise ValueError("the simulation stops before the end of the step")
            self.progress = self._standing()

    def _restart(self, twin: Twin) -> float:
        self._ramps.clear()
        twin.set_tolerance(self._twin.tolerance)
        twin.set_sample_rate(self._twin.sample_rate)
        self._twin = twin
        self._failure = ""
        self._stands = self._untold = True
        self.progress = self._standing()
        return twin.time

    def _halted(self) -> bool:
        return bool(self._failure) or self._paused or not self._listener.ready()

    def _patience(self) -> float:
        """How long to wait for an order [s]."""
        if self._halted():
            self._hold.end()
            return _ALERTNESS
        self._hold.look()
        return _POLL if self._hold.active else 0.0

    def _state(self) -> State:
        if self._failure:
            return State.FAILED
        if self._paused:
            return State.PAUSED
        return State.WAITING if self._stands or self._hold.long else State.RUNNING

    def _standing(self) -> Progress:
        return Progress(
            self._twin.time,
            time.monotonic(),
            self._ran,
            self._lasted,
            time.thread_time(),
            self._pace.overruns,
            self._repeated,
            self._state(),
            self._failure,
            self._hold.total,
        )
