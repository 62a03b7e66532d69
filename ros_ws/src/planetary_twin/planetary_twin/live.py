"""Runs a twin in real time, in a thread of its own, and gives it orders between two intervals."""

from __future__ import annotations

import math
import queue
import threading
import time
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from typing import NamedTuple, Protocol

from planetary_twin_py import OperatingPoint, Twin, Window
from planetary_twin_py.affordable import Affordable, Setting

from .pacing import Pace
from .ramps import Ramps

LONGEST_STEP = 10.0  # [s] that a paused twin makes at a time
_ALERTNESS = 0.1  # [s] after which a paused twin looks whether it is to end


class Listener(Protocol):
    """What hears of a live twin; called in its thread."""

    def prepare(self, window: Window) -> None:
        """An interval has been computed; its wall instant is still to come."""

    def publish(self) -> None:
        """The wall instant of the prepared interval's end is now."""

    def changed(self, point: OperatingPoint, instant: float) -> None:
        """The operating point in force from simulated time `instant` [s] is a new one."""

    def refused(self, reason: str) -> None:
        """What was on its way to new values cannot go on, and stays where it is."""

    def retuned(self, instant: float, before: Setting, affordable: Affordable) -> None:
        """From simulated time `instant` [s] the setting is no more `before`, but `affordable`'s."""

    def goes_on(self, twin: Twin) -> None:
        """After a stop, or from a new start, the present time of `twin` is now."""

    def stopped(self, defect: Exception) -> None:
        """The thread ends because of `defect`."""


class Progress(NamedTuple):
    """Where a live twin stands, taken at the end of an interval."""

    simulated: float  # [s]
    wall: float  # [s] steady clock
    cpu: float  # [s] processor time of the thread
    overruns: int
    repeats: bool  # steady running, which is not computed again
    paused: bool


class LiveTwin:
    """Advances `twin` by `interval` [s] at a time, `rate_factor` simulated seconds per second.

    `affordable` chooses the setting, and may be replaced at any time, from any thread. Orders
    are carried out between two intervals; their futures give the simulated instant [s] of that.
    """

    def __init__(
        self,
        twin: Twin,
        interval: float,
        rate_factor: float,
        affordable: Affordable,
        listener: Listener,
    ) -> None:
        self._twin = twin
        self._interval = interval
        self._pace = Pace(interval / rate_factor)
        self.affordable = affordable
        self._listener = listener
        self._orders: queue.SimpleQueue[tuple[Callable[[], float], Future[float]]] = (
            queue.SimpleQueue()
        )
        self._ramps = Ramps()
        self._paused = False
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, name="twin", daemon=True)
        self._repeated = False
        self.progress = self._standing()

    def start(self) -> Progress:
        """Begin at the twin's present time; returns where that is."""
        self._pace.start()
        begun = self.progress = self._standing()._replace(cpu=0.0)
        self._thread.start()
        return begun

    def stop(self) -> None:
        """End after the interval in progress, which is still published."""
        self._stop.set()
        self._thread.join()

    def submit(self, values: Mapping[str, float]) -> Future[float]:
        """Have `values` of the operating point set."""
        return self._order(lambda: self._set(values))

    def ramp(self, values: Mapping[str, float], duration: float) -> Future[float]:
        """Have `values` of the operating point reached in `duration` [s], interval by interval."""
        return self._order(lambda: self._ramp(values, duration))

    def pause(self, paused: bool) -> Future[float]:
        """Have simulated time stand still, or go on."""
        return self._order(lambda: self._pause(paused))

    def step(self, duration: float) -> Future[float]:
        """Have a paused twin make `duration` [s], as fast as it goes."""
        return self._order(lambda: self._step(duration))

    def restart(self, twin: Twin) -> Future[float]:
        """Have another twin take the place of this one."""
        return self._order(lambda: self._restart(twin))

    def _order(self, order: Callable[[], float]) -> Future[float]:
        future: Future[float] = Future()
        self._orders.put((order, future))
        return future

    def _run(self) -> None:
        try:
            while not self._stop.is_set():
                self._obey()
                if not self._paused:
                    self._pass(self._interval, self._pace.wait)
                self.progress = self._standing()
        except Exception as defect:
            self._listener.stopped(defect)

    def _obey(self) -> None:
        """Carry out what was ordered; a paused twin waits for it."""
        while True:
            try:
                order, future = self._orders.get(block=self._paused, timeout=_ALERTNESS)
            except queue.Empty:
                return
            try:
                future.set_result(order())
            except ValueError as refusal:
                future.set_exception(refusal)

    def _pass(self, duration: float, wait: Callable[[], None]) -> None:
        """One interval, published after `wait`, at the setting that is affordable as far as is
        known; only the wait costs nothing.
        """
        self._follow_ramps()
        affordable = self.affordable
        self._tune(affordable)
        begin = time.monotonic()
        window = self._twin.advance(duration)
        self._listener.prepare(window)
        prepared = time.monotonic()
        wait()
        waited = time.monotonic() - prepared
        self._listener.publish()
        affordable.observe(time.monotonic() - begin - waited, window.repeated)
        self._repeated = window.repeated

    def _tune(self, affordable: Affordable) -> None:
        twin, setting = self._twin, affordable.setting
        before = Setting(twin.tolerance, twin.sample_rate)
        if setting != before:
            twin.set_tolerance(setting.tolerance)
            instant = twin.set_sample_rate(setting.sample_rate)
            self._listener.retuned(instant, before, affordable)

    def _set(self, values: Mapping[str, float]) -> float:
        self._ramps.leave(values)
        return self._change(values)

    def _change(self, values: Mapping[str, float]) -> float:
        instant = self._twin.set(**values)
        self.affordable.relearn()
        self._listener.changed(self._twin.operating_point, instant)
        return instant

    def _ramp(self, values: Mapping[str, float], duration: float) -> float:
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

    def _pause(self, paused: bool) -> float:
        if self._paused and not paused:
            self._listener.goes_on(self._twin)
            self._pace.start()
        self._paused = paused
        return self._twin.time

    def _step(self, duration: float) -> float:
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
            self._pass(min(self._interval, left), lambda: None)
            self.progress = self._standing()
        return self._twin.time

    def _restart(self, twin: Twin) -> float:
        self._ramps.clear()
        twin.set_tolerance(self._twin.tolerance)
        twin.set_sample_rate(self._twin.sample_rate)
        self._twin = twin
        self._pace.start()
        self._listener.goes_on(twin)
        self._listener.changed(twin.operating_point, twin.time)
        return twin.time

    def _standing(self) -> Progress:
        return Progress(
            self._twin.time,
            time.monotonic(),
            time.thread_time(),
            self._pace.overruns,
            self._repeated,
            self._paused,
        )
