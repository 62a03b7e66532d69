"""Runs a twin in real time in a separate thread; commands take effect between two intervals."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from typing import Any, Protocol

from planetary_twin_py import Twin, Window
from planetary_twin_py.run.limits import RunawayError
from planetary_twin_py.run.quality_control import QualityControl, Setting
from planetary_twin_py.scene.live import PORT_FIELDS

from ...base.command_queue import CommandQueue
from ..progress import Progress, State
from ..publishing.publishers import Telemetry
from ..shaft_commands import ShaftCommands
from .hold import Hold
from .pace import Pace
from .ramps import Ramps
from .turns import Turns

NO_CLOCK = "use_sim_time: the twin waits for the first message on /clock"
SHORTEST_STEP, LONGEST_STEP = 1e-6, 10.0  # [s] of a paused twin; stamps have whole nanoseconds
_STOP_POLL = 0.1  # [s] between two checks of a halted twin whether it may run
_ROOM_POLL = 2e-3  # [s] between two checks whether the recorder has caught up
_STOPPED = "the simulation has stopped"


class TwinNode(Protocol):
    """Callbacks of a live twin, in its thread, or in that of a command while it halts."""

    def computed(self, window: Window) -> None:
        """Receive a computed interval before the wall time of its end."""

    def refused(self, reason: str) -> None:
        """Receive the reason why a ramp ended early, or why a command had no effect."""

    def retuned(self, instant: float, before: Setting, quality: QualityControl) -> None:
        """From simulated time `instant` [s], the setting of `quality` replaces `before`."""

    def ready(self) -> bool:
        """Return whether time can pass: for example, the clock to follow is available."""

    def has_room(self) -> bool:
        """Return whether the recorder has kept up and the next interval may be published."""

    def stopped(self, defect: Exception) -> None:
        """Receive the exception that ended the thread."""


class LiveTwin:
    """
    Advances `twin` by `interval` [s] at a time.

    It runs at `rate_factor` simulated seconds per second, or as fast as possible if that is 0.
    `quality` chooses tolerance and sample rate; any thread may replace it at any time. Commands
    are executed between two intervals, those of a halted twin at once in the thread that gives
    them; their futures return the simulated instant [s].

    `port_commands` are asked for the commands at the ports before each interval. `telemetry`
    publishes the intervals and the changes of operating point and ports.

    Above real time and in steps, the twin waits for its recorder. At real time or below, it does
    not.
    """

    def __init__(
        self,
        twin: Twin,
        interval: float,
        rate_factor: float,
        quality: QualityControl,
        node: TwinNode,
        telemetry: Telemetry,
        port_commands: ShaftCommands,
    ) -> None:
        self._twin = twin
        self._telemetry = telemetry
        self._port_commands = port_commands
        self._interval = interval
        self._stop = threading.Event()
        self._pace = Pace(interval / rate_factor if rate_factor else 0.0, self._stop.wait)
        self._hold = Hold(lambda: 0.0 < rate_factor <= 1.0 or node.has_room())
        self.quality = quality
        self._node = node
        self._commands = CommandQueue(self._set)
        self._turns = Turns(self._serve)
        self._ramps = Ramps()
        self._paused = False
        self._failure = ""  # why the twin is stopped until a restart
        self._halted = True  # as of the last interval
        # The last entry of the log; the real-time report removes earlier entries.
        oil = twin.temperatures.get("oil")
        self._noted = twin.log[-1]._replace(time=twin.time, oil_temperature=oil)
        self._due = [self._noted]  # changes that have not been published
        self._at_zero = [self._noted]  # those at time zero, published again with each origin
        self._thread = threading.Thread(target=self._run, name="twin", daemon=True)
        self._repeated = False
        self._ran = self._lasted = 0.0  # see `Progress`
        self._mark = 0.0  # [s] wall time at which the last interval ended
        self._cpu = 0.0  # [s] processor time of the thread
        self.progress = self._present()

    def start(self) -> Progress:
        """Start at the twin's present time; returns the progress at the start."""
        start = self.progress = self._present()
        self._thread.start()
        return start

    def stop(self) -> None:
        """Stop after the interval in progress, which is published at once."""
        self._stop.set()
        self._turns.wake()
        self._thread.join()

    def submit(self, values: Mapping[str, Any]) -> Future[float]:
        """Set `values` of the operating point and the ports, by the arguments of `Twin.set`."""
        return self._given_in_turn(self._commands.change(values))

    def ramp(self, values: Mapping[str, float], duration: float) -> Future[float]:
        """Change the operating point linearly to `values` within `duration` [s]."""
        return self._given_in_turn(self._commands.put(lambda: self._ramp(values, duration)))

    def pause(self, paused: bool) -> Future[float]:
        """Pause simulated time, or resume it."""
        return self._given_in_turn(self._commands.put(lambda: self._pause(paused)))

    def step(
        self,
        duration: float,
        commands: Sequence[Mapping[str, float]] = ({},),
        show: Callable[[Twin], None] = lambda twin: None,
    ) -> Future[float]:
        """
        Advance a paused twin by `duration` [s] for each of `commands`, as fast as possible.

        Each command acts at the ports from the start of its step. `show` is called with the twin
        at the end of each step. Steps have no deadline, so their results do not depend on the load
        of the computer, see `QualityControl.without_deadline`.
        """
        return self._given_in_turn(
            self._commands.put(lambda: self._steps(duration, commands, show))
        )

    def between(self, action: Callable[[Twin], None]) -> Future[float]:
        """Call `action` with the twin between two intervals."""

        def act() -> float:
            action(self._twin)
            return self._twin.time

        return self._given_in_turn(self._commands.put(act))

    def restart(self, twin: Twin) -> Future[float]:
        """Replace the twin by `twin`."""
        return self._given_in_turn(self._commands.put(lambda: self._restart(twin)))

    def _given_in_turn(self, command: Future[float]) -> Future[float]:
        """Have the queued `command` executed."""
        self._turns.call()
        if self._turns.ended:
            self._commands.refuse(_STOPPED)
        return command

    def _run(self) -> None:
        try:
            with self._turns:
                while not self._stop.is_set():
                    self._turns.rest(self._patience())
                    if self._serve() and self._run_on():
                        before, self._mark = self._mark, time.monotonic()
                        self._ran += self._interval
                        self._lasted += self._mark - before
                    self._cpu = time.thread_time()
                    self.progress = self._present()
        except Exception as defect:
            self._node.stopped(defect)
        finally:
            self._commands.refuse(_STOPPED)

    def _serve(self) -> bool:
        """Execute the commands that wait, and publish what they change; whether time runs."""
        answers = self._commands.execute()
        was_halted, self._halted = self._halted, self._must_halt()
        if self._halted:
            self._port_commands.collect()
        if was_halted and not self._halted:
            self._resume()
            self._pace.start()
            self._mark = time.monotonic()
        running = not (self._halted or self._hold.active)
        if running:
            self._follow_ramps()
        if running or self._node.ready():
            self._announce()
        if answers:  # the progress that a client reads next includes its command
            self.progress = self._present()
        for answer in answers:
            answer()
        return running

    def _resume(self) -> None:
        """Resume time; at time zero, publish a new origin of the run and all changes after it."""
        self._telemetry.resume(self._twin)
        if self._twin.time == 0.0:
            self._due = list(self._at_zero)

    def _announce(self) -> None:
        """Publish the changes of operating point and ports, before the states they govern."""
        if not self._due:
            return
        if self._halted:
            self._resume()
        for change in self._due:
            self._telemetry.announce(change)
        self._due.clear()

    def _note(self) -> None:
        """Note the last change, except of tolerance or sample rate, which each state contains."""
        before, self._noted = self._noted, self._twin.log[-1]
        if self._noted is before or self._noted.values == before.values:
            return
        self._due.append(self._noted)
        if self._twin.time == 0.0:
            self._at_zero.append(self._noted)

    def _given(self, interval: float) -> dict[str, float]:
        """Return the commands for the next `interval` [s]; a brake changes the ports."""
        given = self._port_commands.given(self._twin, interval)
        self._note()
        return given

    def _run_on(self) -> bool:
        """Advance by an interval under the newest commands, or without them if it refuses them."""
        try:
            given = self._given(self._interval)
            self._announce()
            return self._advance(self._interval, self._pace.wait, given, self.quality)
        except ValueError as refusal:
            self._port_commands.refuse(str(refusal))
            self._node.refused(f"a command has no effect: {refusal}")
            return self._advance(self._interval, self._pace.wait, {}, self.quality)

    def _advance(
        self,
        duration: float,
        wait: Callable[[], None],
        given: Mapping[str, float],
        quality: QualityControl,
    ) -> bool:
        """
        Compute one interval and publish it after `wait`; returns False if the twin fails.

        Raises `ValueError` if the twin does not accept `given`; then no time has passed.

        `quality` chooses the setting beforehand and then observes the computing time, which does
        not include the wait.
        """
        self._tune(quality)
        begin, cpu = time.monotonic(), time.thread_time()
        try:
            window = self._twin.advance(duration, **given)
        except RunawayError as reason:  # nothing of the interval is published
            self._failure = str(reason)
            return False
        self._telemetry.prepare(window)
        self._node.computed(window)
        prepared = time.monotonic()
        wait()
        waited = time.monotonic() - prepared
        if self._telemetry.publish():
            self._pace.start()
        work = time.thread_time() - cpu
        quality.observe(time.monotonic() - begin - waited, work, window.repeated)
        self._repeated = window.repeated
        return True

    def _tune(self, quality: QualityControl) -> None:
        twin, setting = self._twin, quality.setting
        before = Setting(twin.tolerance, twin.sample_rate)
        if setting != before:
            twin.set_tolerance(setting.tolerance)
            instant = twin.set_sample_rate(setting.sample_rate)
            self._node.retuned(instant, before, quality)

    def _set(self, values: Mapping[str, Any]) -> float:
        self._ramps.leave(values)
        return self._change(values)

    def _change(self, values: Mapping[str, Any]) -> float:
        self._refuse_after_failure()
        if PORT_FIELDS.keys() & values.keys():  # the ports without the brake change
            self._port_commands.release(self._twin)
            self._note()
        instant = self._twin.set(**values)
        self._note()
        self.quality.relearn()
        return instant

    def _ramp(self, values: Mapping[str, float], duration: float) -> float:
        self._refuse_after_failure()
        point = self._twin.operating_point
        first = {name: getattr(point, name) for name in values}
        self._ramps.start(self._twin.time, duration, first, values)
        return self._twin.time

    def _follow_ramps(self) -> None:
        """Set ramped quantities to their values at the end of the next interval."""
        values = self._ramps.values(self._twin.time + self._interval)
        if not values:
            return
        try:
            self._change(values)
        except ValueError as refusal:  # the twin keeps its last good state
            self._ramps.clear()
            self._node.refused(f"a ramp ends before its final values: {refusal}")

    def _refuse_after_failure(self) -> None:
        if self._failure:
            raise ValueError(f"{self._failure}; ~/reset starts a new run with the parameters")

    def _pause(self, paused: bool) -> float:
        self._refuse_after_failure()
        self._paused = paused
        return self._twin.time

    def _steps(
        self,
        duration: float,
        commands: Sequence[Mapping[str, float]],
        show: Callable[[Twin], None],
    ) -> float:
        self._refuse_after_failure()
        if not self._paused:
            raise ValueError(f"duration = {duration:g} s: the twin runs; pause it first")
        if not SHORTEST_STEP <= duration <= LONGEST_STEP:
            raise ValueError(
                f"duration = {duration:g} s: must be within {SHORTEST_STEP:g} and "
                f"{LONGEST_STEP:g} s"
            )
        if duration * len(commands) > LONGEST_STEP * (1.0 + 1e-9):
            raise ValueError(
                f"commands: {len(commands)} steps of {duration:g} s: must be at most "
                f"{LONGEST_STEP:g} s in total"
            )
        if not self._telemetry.has_clock():
            raise ValueError(f"{NO_CLOCK}; step the twin then")
        self._wait_until(self._node.ready)
        self._resume()
        received = self._given(0.0)
        for n, command in enumerate(commands):
            try:
                self._step(duration, command if n else {**received, **command})
            except ValueError as refusal:
                place = f"commands[{n}]: " if len(commands) > 1 else ""
                raise ValueError(f"{place}{refusal}") from None
            show(self._twin)
        return self._twin.time

    def _step(self, duration: float, given: Mapping[str, float]) -> None:
        count = math.ceil(duration / self._interval - 1e-9)
        quality = self.quality.without_deadline()
        for n in range(count):
            left = duration - n * self._interval
            self._follow_ramps()
            self._announce()
            self._wait_until(self._node.has_room)  # steps are not paced
            commands = given if n == 0 else {}
            self._advance(min(self._interval, left), lambda: None, commands, quality)
            self.progress = self._present()
            self._refuse_after_failure()

    def _wait_until(self, present: Callable[[], bool]) -> None:
        """Wait within a step until the recorder is `present`, or has caught up."""
        while not present():
            if self._stop.wait(_ROOM_POLL):
                raise ValueError("the simulation stops before the end of the step")
            self.progress = self._present()

    def _restart(self, twin: Twin) -> float:
        self._ramps.clear()
        twin.set_tolerance(self._twin.tolerance)
        twin.set_sample_rate(self._twin.sample_rate)
        self._twin = twin
        self._failure = ""
        self._halted = True
        self._noted = twin.log[-1]
        self._due, self._at_zero = [self._noted], [self._noted]
        self.progress = self._present()
        return twin.time

    def _must_halt(self) -> bool:
        return bool(self._failure) or self._paused or not self._node.ready()

    def _patience(self) -> float:
        """Return how long to rest [s]."""
        if self._must_halt():
            self._hold.end()
            return _STOP_POLL
        self._hold.update()
        return _ROOM_POLL if self._hold.active else 0.0

    def _state(self) -> State:
        if self._failure:
            return State.FAILED
        if self._paused:
            return State.PAUSED
        return State.WAITING if self._halted or self._hold.long else State.RUNNING

    def _present(self) -> Progress:
        return Progress(
            self._twin.time,
            time.monotonic(),
            self._ran,
            self._lasted,
            self._cpu,
            self._pace.overruns,
            self._repeated,
            self._state(),
            self._failure,
            self._hold.total,
        )
