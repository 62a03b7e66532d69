"""One run, from the start of two processes to a finished recording."""

from __future__ import annotations

import contextlib
import os
import shutil
import signal
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console

from ..clients.loopback import stay_on_this_machine
from ..simulation.publishing.publishers import STALL
from .node_process import Child, RunError, alone, conflict
from .operator import NODE, Operator
from .outcome import Outcome, read_outcome
from .progress import Show
from .tour import Stop

_START = 60.0  # [s] longest wait for the nodes to discover each other
_BUILD = 300.0  # [s] longest wait for the model
_END = 3.0  # [s] longest wait for the twin's last report
SILENCE = 300.0  # [s] longest silence of a running twin, the lease of config/loopback.xml


@dataclass(frozen=True)
class Plan:
    """
    What to run.

    `settings` are further parameters of the simulation, `stops` changes during the run.
    """

    scene: str
    duration: float  # [s] simulated
    folder: Path
    settings: dict[str, object]
    stops: list[Stop]
    namespace: str = "/planetary_twin"


def run_session(plan: Plan, console: Console) -> Outcome:
    """
    Run `plan` to its end, or until interrupted; in both cases, the recording is finished.

    The progress is shown on `console`. Raises `RunError` if a node fails. An interrupt before the
    first state leaves no recording and raises `KeyboardInterrupt`.
    """
    stay_on_this_machine()
    with alone(plan.namespace):
        return _run(plan, console)


def _run(plan: Plan, console: Console) -> Outcome:
    logger = Child("logger", plan.namespace, logger_parameters(plan.scene, plan.folder))
    with logger:
        with contextlib.ExitStack() as stack:
            with _removed_on_failure(logger, plan.folder):
                own = {"scene": plan.scene, "autostart": "false", "wait_for": "logger"}
                simulation = Child(NODE, plan.namespace, own | plan.settings)
                stack.enter_context(simulation)

                def watch() -> None:
                    logger.check()
                    simulation.check()

                operator = stack.enter_context(Operator(plan.namespace, watch))
                show = stack.enter_context(Show(console, plan.duration))
                _begin(operator, simulation)
            interrupted = False
            with _named_on_failure(plan.folder):
                try:
                    _drive(operator, plan, show)
                except KeyboardInterrupt:
                    interrupted = True
            with undisturbed():
                _finish(operator)
        if logger.stop() != 0:
            raise RunError(logger.last_line() or "logger: ended with an error")
    names = dict.fromkeys([plan.folder.name, *operator.recordings])
    folders = [plan.folder.with_name(name) for name in names]
    stopped = len(names) > 1 or not operator.recorder.file
    published, figures, summed = operator.published(), operator.figures, operator.summed
    outcome = read_outcome(folders, published, figures, stopped, summed)
    if interrupted and outcome.duration == 0.0:
        shutil.rmtree(plan.folder, ignore_errors=True)
        raise KeyboardInterrupt
    return outcome


def logger_parameters(scene: str, folder: Path) -> dict[str, object]:
    """Return the parameters of a logger that records into `folder`."""
    return {"directory": folder.parent.absolute(), "name": folder.name, "scene": scene}


def _begin(operator: Operator, simulation: Child) -> None:
    """Start the twin; if that fails, another run's simulation may have answered."""
    try:
        _start(operator)
    except RunError as failure:
        _refuse_other_publishers(operator)
        raise RunError(": ".join(filter(None, (str(failure), simulation.last_error())))) from None


def _start(operator: Operator) -> None:
    """Build the model, and run it once the logger has subscribed to every topic."""
    operator.change_state(NODE, "configure", "unconfigured", "inactive", _BUILD)

    if not operator.wait(lambda: not operator.unsubscribed(), _START):
        topics = operator.unsubscribed()
        raise RunError(f"logger: within {_START:g} s, it does not subscribe to {topics}")
    _refuse_other_publishers(operator)
    operator.change_state(NODE, "activate", "inactive", "active", _START)


def _refuse_other_publishers(operator: Operator) -> None:
    """Raise `RunError` if other nodes publish here: their messages would be recorded, too."""
    if others := operator.other_publishers():
        raise RunError(conflict(", ".join(others)))


@contextlib.contextmanager
def _removed_on_failure(logger: Child, folder: Path) -> Iterator[None]:
    """Remove the recording of a twin that did not start, unless another process created it."""
    try:
        yield
    except (RunError, KeyboardInterrupt):
        with undisturbed():
            logger.stop()
            if f"recording into {folder.absolute()}{os.sep}" in logger.output():
                shutil.rmtree(folder, ignore_errors=True)
        raise


@contextlib.contextmanager
def _named_on_failure(folder: Path) -> Iterator[None]:
    """Add the folder of the recording to the message of a run that fails."""
    try:
        yield
    except RunError as failure:
        raise RunError(f"{failure}; the recording is in {folder}") from None


def _drive(operator: Operator, plan: Plan, show: Show) -> None:
    """Follow the twin to the end of the run, and change the operating point as planned."""
    stops = list(plan.stops)
    seen, number = 0.0, 0
    while seen < plan.duration:
        state = operator.next_state(number, SILENCE)
        if state is None:
            show.halt(seen, operator.halted() or "no answer")
            continue
        seen, number = state.simulated_time, state.sequence
        show.update(state, operator.figures.get("real_time_factor", "-"))
        while stops and stops[0].time <= seen:
            stop = stops.pop(0)
            if stop.values:
                operator.set(stop.values)
            show.say(seen, stop.caption)


def _finish(operator: Operator) -> None:
    """
    Stop the twin, then wait until the logger has counted all messages reported as published.

    If the logger stalls, the wait lasts as long as publishers keep messages for it.
    """
    operator.change_state(NODE, "deactivate", "active", "inactive", _END + 2.0)
    operator.wait(lambda: operator.figures.get("state") == "stopped", _END)

    def done() -> bool:
        accounted = operator.accounted()
        everything = all(accounted.get(name, 0) >= n for name, n in operator.published().items())
        return everything or not operator.recorder.file

    before = -1
    while (now := sum(operator.accounted().values())) > before and not operator.wait(done, STALL):
        before = now


@contextlib.contextmanager
def undisturbed() -> Iterator[None]:
    """Ignore further signals: the block is short and must be completed."""
    handlers = {number: signal.signal(number, signal.SIG_IGN) for number in _INTERRUPTS}
    try:
        yield
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)


_INTERRUPTS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
