"""Runs a twin in real time, in a thread of its own, and changes it between two intervals."""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Mapping
from concurrent.futures import Future
from typing import NamedTuple, Protocol

from planetary_twin_py import Twin, Window
from planetary_twin_py.tolerance import AffordableTolerance

from .pacing import Pace


class Listener(Protocol):
    """What hears of a live twin; called in its thread."""

    def prepare(self, window: Window) -> None:
        """An interval has been computed; its wall instant is still to come."""

    def publish(self) -> None:
        """The wall instant of the prepared interval's end is now."""

    def changed(self, instant: float) -> None:
        """The operating point in force from simulated time `instant` [s] is a new one."""

    def retuned(self, instant: float, affordable: AffordableTolerance) -> None:
        """From simulated time `instant` [s] the tolerance is the one that is `affordable`."""

    def stopped(self, defect: Exception) -> None:
        """The thread ends because of `defect`."""


class Progress(NamedTuple):
    """Where a live twin stands, taken at the end of an interval."""

    simulated: float  # [s]
    wall: float  # [s] steady clock
    cpu: float  # [s] processor time of the thread
    overruns: int
    repeats: bool  # steady running, which is not computed again


class LiveTwin:
    """Advances `twin` by `interval` [s] at a time, `rate_factor` simulated seconds per second.

    `affordable` chooses the tolerance, and may be replaced at any time, from any thread.
    """

    def __init__(
        self,
        twin: Twin,
        interval: float,
        rate_factor: float,
        affordable: AffordableTolerance,
        listener: Listener,
    ) -> None:
        self._twin = twin
        self._interval = interval
        self._pace = Pace(interval / rate_factor)
        self.affordable = affordable
        self._listener = listener
        self._changes: queue.SimpleQueue[tuple[Mapping[str, float], Future[float]]] = (
            queue.SimpleQueue()
        )
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
        """Have `values` set between two intervals; the future gives the simulated instant [s]."""
        future: Future[float] = Future()
        self._changes.put((values, future))
        return future

    def _run(self) -> None:
        try:
            while not self._stop.is_set():
                self._apply_changes()
                self._listener.prepare(self._advance())
                self._pace.wait()
                self._listener.publish()
                self.progress = self._standing()
        except Exception as defect:
            self._listener.stopped(defect)

    def _advance(self) -> Window:
        """The next interval, at the tolerance that is affordable as far as is known."""
        affordable = self.affordable
        if affordable.tolerance != self._twin.tolerance:
            instant = self._twin.set_tolerance(affordable.tolerance)
            self._listener.retuned(instant, affordable)
        begin = time.monotonic()
        window = self._twin.advance(self._interval)
        affordable.observe(time.monotonic() - begin, window.repeated)
        self._repeated = window.repeated
        return window

    def _apply_changes(self) -> None:
        while not self._changes.empty():
            values, future = self._changes.get()
            try:
                instant = self._twin.set(**values)
            except ValueError as refusal:
                future.set_exception(refusal)
                continue
            self.affordable.relearn()
            self._listener.changed(instant)
            future.set_result(instant)

    def _standing(self) -> Progress:
        return Progress(
            self._twin.time,
            time.monotonic(),
            time.thread_time(),
            self._pace.overruns,
            self._repeated,
        )
