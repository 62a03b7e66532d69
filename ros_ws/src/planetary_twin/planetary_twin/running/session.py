"""The course of one run, from two fresh processes to a finished recording."""

from __future__ import annotations

import contextlib
import fcntl
import os
import shutil
import signal
import tempfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from rich.console import Console

from planetary_twin_py.tolerance import AUTOMATIC

from ..network import stay_on_this_machine
from ..telemetry import STALL
from .children import Child, RunError
from .operator import Operator
from .outcome import Outcome, read_outcome
from .show import Show
from .tour import Stop

_START = 60.0  # [s] longest wait for the nodes to find one another
_BUILD = 300.0  # [s] longest wait for the model, which a first run compiles
_END = 3.0  # [s] longest wait for the twin's last report
SILENCE = 10.0  # [s] longest silence of a running twin


@dataclass(frozen=True)
class Plan:
    """What to run; `values` are parameters of the simulation given at start."""

    scene: str
    duration: float  # [s] simulated
    folder: Path
    rate_factor: float = 1.0
    tolerance: float = AUTOMATIC
    values: Mapping[str, float] = field(default_factory=dict)
    stops: list[Stop] = field(default_factory=list)
    namespace: str = "/planetary_twin"


def run_session(plan: Plan, console: Console) -> Outcome:
    """
    Run `plan` to its end, or until interrupted; either way the recording is finished.

    Raises `RunError` where a node fails.
    """
    stay_on_this_machine()
    with _alone(plan.namespace):
        return _run(plan, console)


def _run(plan: Plan, console: Console) -> Outcome:
    logger = Child("logger", plan.namespace, _logger_parameters(plan))
    with logger:
        simulation = Child("simulation", plan.namespace, _simulation_parameters(plan))

        def watch() -> None:
            logger.check()
            simulation.check()

        with (
            simulation,
            Operator(plan.namespace, watch) as operator,
            Show(console, plan.duration) as show,
        ):
            with _nothing_left(logger, plan.folder):
                _begin(operator, simulation)
            with contextlib.suppress(KeyboardInterrupt), _told_where(plan.folder):
                _drive(operator, plan, show)
            with _undisturbed():
                _finish(operator)
        if logger.stop() != 0:
            raise RunError(logger.last_words() or "logger: ended with an error")
    names = dict.fromkeys([plan.folder.name, *operator.recordings])
    folders = [plan.folder.with_name(name) for name in names]
    stopped = len(names) > 1 or not operator.recorder.file
    return read_outcome(folders, operator.published(), operator.figures, stopped)


def _logger_parameters(plan: Plan) -> dict[str, object]:
    return {
        "directory": plan.folder.parent.absolute(),
        "name": plan.folder.name,
        "scene": plan.scene,
    }


def _simulation_parameters(plan: Plan) -> dict[str, object]:
    return {
        "scene": plan.scene,
        "rate_factor": plan.rate_factor,
        "tolerance": plan.tolerance,
        "autostart": "false",
        "wait_for": "logger",
        **plan.values,
    }


def _begin(operator: Operator, simulation: Child) -> None:
    """Bring the twin up; what goes wrong may be that another run's simulation answered."""
    try:
        _bring_up(operator)
    except RunError as failure:
        _refuse_company(operator)
        raise RunError(": ".join(filter(None, (str(failure), simulation.complaint())))) from None


def _bring_up(operator: Operator) -> None:
    """Build the model, and let it run once the logger hears every topic: nothing gets lost."""
    operator.bring("configure", "unconfigured", "inactive", _BUILD)

    if not operator.wait(lambda: not operator.unheard(), _START):
        raise RunError(f"logger: after {_START:g} s it does not hear {operator.unheard()}")
    _refuse_company(operator)
    operator.bring("activate", "inactive", "active", _START)


def _refuse_company(operator: Operator) -> None:
    """Raise `RunError` if others publish here: they would be recorded, and drive what looks."""
    if others := operator.company():
        raise RunError(_company(", ".join(others)))


def _company(others: str = "another twin") -> str:
    return f"{others} runs on ROS_DOMAIN_ID = {_domain()}: end it, or choose another domain"


def _domain() -> str:
    return os.environ.get("ROS_DOMAIN_ID", "0")


@contextlib.contextmanager
def _alone(namespace: str) -> Iterator[None]:
    """
    Raise `RunError` where a run of this user is under way in the same domain and namespace.

    Discovery may take longer than a short run; a lock does not, and ends with its process.
    """
    name = f"planetary_twin_{os.getuid()}_{_domain()}{namespace.replace('/', '_')}.lock"
    path = os.path.join(tempfile.gettempdir(), name)
    lock = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW, 0o600)
    try:
        _take(lock)
        yield
    finally:
        os.close(lock)


def _take(lock: int) -> None:
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise RunError(_company()) from None


@contextlib.contextmanager
def _nothing_left(logger: Child, folder: Path) -> Iterator[None]:
    """Remove the recording of a twin that has not begun; never a folder that others made."""
    try:
        yield
    except (RunError, KeyboardInterrupt):
        with _undisturbed():
            logger.stop()
            if f"recording into {folder.absolute()}{os.sep}" in logger.words():
                shutil.rmtree(folder, ignore_errors=True)
        raise


@contextlib.contextmanager
def _told_where(folder: Path) -> Iterator[None]:
    """Name the recording of a run that fails."""
    try:
        yield
    except RunError as failure:
        raise RunError(f"{failure}; what was recorded is in {folder}") from None


def _drive(operator: Operator, plan: Plan, show: Show) -> None:
    """Follow the twin to the end of the run, turning the knobs on the way."""
    stops = list(plan.stops)
    seen, number = 0.0, 0
    while seen < plan.duration:
        state = operator.next_state(number, SILENCE / min(plan.rate_factor or 1.0, 1.0))
        if state is None:
            show.stand(seen, operator.stands())
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
    Stop the twin, then wait until the logger has accounted for what it says it has published.

    A logger that stands still is waited for as long as publishers keep messages for it.
    """
    operator.bring("deactivate", "active", "inactive", _END + 2.0)
    operator.wait(lambda: operator.figures.get("state") == "stopped", _END)

    def done() -> bool:
        accounted = operator.accounted()
        everything = all(accounted.get(name, 0) >= n for name, n in operator.published().items())
        return everything or not operator.recorder.file

    before = -1
    while (now := sum(operator.accounted().values())) > before and not operator.wait(done, STALL):
        before = now


@contextlib.contextmanager
def _undisturbed() -> Iterator[None]:
    """Ignore further Ctrl-C: what runs inside is short and must come to its end."""
    handlers = {number: signal.signal(number, signal.SIG_IGN) for number in _INTERRUPTS}
    try:
        yield
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)


_INTERRUPTS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
