"""Real nodes as separate processes, on a DDS domain that no other test uses."""

import signal
import subprocess
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from domains import private_domain
from planetary_twin.simulation import shaft_commands
from planetary_twin_msgs.msg import OperatingPoint
from small_disk import mounted
from std_srvs.srv import Trigger

import planetary_twin_py as pt

from .peer import LATCHED, TWIN, Peer, connected
from .programs import Executed, Forked, Program

_TIMEOUT = 5.0  # [s] for a node to end after a signal


Start = Callable[..., Program]
Play = Callable[..., Program]


@pytest.fixture
def start(domain: int, tmp_path: Path) -> Iterator[Start]:
    """Start a node with arguments; processes that still run at the end are ended."""
    with starting(Forked, tmp_path) as run:
        yield run


@pytest.fixture
def execute(domain: int, tmp_path: Path) -> Iterator[Start]:
    """Start a module with arguments, as users do: for tests of the start itself."""
    with starting(Executed, tmp_path) as run:
        yield run


@pytest.fixture
def play(start: Start) -> Play:
    """Start `planetary-twin replay` with arguments."""

    def replay(*arguments: str | Path) -> Program:
        return start("planetary_twin_py.cli", "replay", *map(str, arguments))

    return replay


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """The steady time of commands [s], which a test sets."""
    now = [0.0]
    monkeypatch.setattr(shaft_commands, "time", SimpleNamespace(monotonic=lambda: now[0]))
    return now


@contextmanager
def starting(kind: type[Executed | Forked], place: Path) -> Iterator[Start]:
    """
    Start modules in a folder, with parameters by name.

    Those that still run at the end, also a failed one, are ended.
    """
    processes: list[Program] = []

    def run(module: str, *arguments: str, **parameters: Any) -> Program:
        given = [word for name, value in parameters.items() for word in ("-p", f"{name}:={value}")]
        options = ("--ros-args", *given) if given else ()
        processes.append(kind(module, *arguments, *options, cwd=place))
        return processes[-1]

    try:
        yield run
    finally:
        _end(processes)


def _end(processes: list[Program]) -> None:
    # SIGTERM first: a killed process leaves its shared memory behind.
    for process in processes:
        if process.poll() is None:
            process.send_signal(signal.SIGCONT)
            process.terminate()
    for process in processes:
        try:
            process.wait(_TIMEOUT)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
        process.close()


@dataclass(frozen=True)
class RunningTwin:
    """A simulation shared by the tests of a module, and a participant that subscribes to it."""

    domain: int
    user: Peer
    points: list[OperatingPoint]

    def restore(self) -> None:
        """Start again at the operating point of the scene; `points` keeps that one only."""
        scene = pt.load_scene("paper").operating_point.model_dump()
        # Setting a value ends its ramp, so all are set.
        answer = self.user.set(f"{TWIN}/simulation", atomically=True, **scene)
        assert answer.successful, answer.reason
        before = len(self.points)
        assert self.user.call(Trigger, f"{TWIN}/simulation/reset", Trigger.Request()).success

        def started() -> bool:
            return any(point.simulated_time == 0.0 for point in self.points[before:])

        self.user.until(started)
        del self.points[:-1]


@pytest.fixture(scope="module")
def running_twin(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningTwin]:
    """A simulation with its defaults, started once for the tests of a module."""
    place = tmp_path_factory.mktemp("running_twin")
    with private_domain() as domain, pytest.MonkeyPatch.context() as environment:
        environment.setenv("ROS_DOMAIN_ID", str(domain))
        with starting(Forked, place) as start, connected() as user:
            start("planetary_twin.simulation")
            points = user.listen(OperatingPoint, f"{TWIN}/operating_point", LATCHED)
            user.until(lambda: points)
            yield RunningTwin(domain, user, points)


@pytest.fixture
def user(running_twin: RunningTwin) -> Peer:
    """The participant of the module's running twin."""
    return running_twin.user


@pytest.fixture
def points(
    running_twin: RunningTwin, monkeypatch: pytest.MonkeyPatch
) -> Iterator[list[OperatingPoint]]:
    """
    The operating points published by the module's running twin, reset to that of its scene.

    Commands that a test starts find this twin.
    """
    monkeypatch.setenv("ROS_DOMAIN_ID", str(running_twin.domain))
    yield running_twin.points
    running_twin.restore()


@pytest.fixture
def peer(domain: int) -> Iterator[Peer]:
    """Another participant, as a user's program."""
    with connected() as user:
        yield user


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A file system of one megabyte."""
    with mounted(tmp_path / "disk") as place:
        yield place


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark tests that start nodes as slow: they take seconds each."""
    here = Path(__file__).parent
    for item in items:
        if item.path.is_relative_to(here):
            item.add_marker(pytest.mark.slow)
