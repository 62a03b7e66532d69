"""Real nodes as processes of their own, on a DDS domain no other test uses."""

from __future__ import annotations

import fcntl
import itertools
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from planetary_twin_msgs.msg import OperatingPoint
from small_disk import mounted

from .peer import LATCHED, TWIN, Peer

_DOMAINS = itertools.count(os.getpid())


@pytest.fixture
def domain(monkeypatch: pytest.MonkeyPatch) -> Iterator[int]:
    """A domain for this test, also in the environment of what it starts."""
    with _free_domain() as number:
        monkeypatch.setenv("ROS_DOMAIN_ID", str(number))
        monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        monkeypatch.setenv("ROS_PYTHON_CHECK_FIELDS", "1")
        yield number


@contextmanager
def _free_domain() -> Iterator[int]:
    """The next domain that tests of another process do not use either."""
    for number in (1 + count % 100 for count in _DOMAINS):
        path = Path(tempfile.gettempdir()) / f"planetary_twin_test_domain_{number}.lock"
        with path.open("w") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                continue
            yield number
            return


Start = Callable[..., "subprocess.Popen[str]"]


@pytest.fixture
def start(domain: int, tmp_path: Path) -> Iterator[Start]:
    """Start a module with arguments; whatever still runs at the end is killed."""
    processes: list[subprocess.Popen[str]] = []

    def run(module: str, *arguments: str) -> subprocess.Popen[str]:
        process = subprocess.Popen(
            [sys.executable, "-m", module, *arguments],
            cwd=tmp_path,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        processes.append(process)
        return process

    yield run
    for process in processes:
        if process.poll() is None:
            process.send_signal(signal.SIGKILL)
        process.communicate()


@pytest.fixture
def points(peer: Peer, start: Start) -> list[OperatingPoint]:
    """What a running simulation has published as its operating point."""
    start("planetary_twin.simulation")
    points = peer.listen(OperatingPoint, f"{TWIN}/operating_point", LATCHED)
    peer.until(lambda: points, 120.0)
    return points


@pytest.fixture
def peer(domain: int) -> Iterator[Peer]:
    """Another participant, as a user's own program."""
    user = Peer()
    yield user
    user.close()


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A file system of one megabyte."""
    with mounted(tmp_path / "disk") as place:
        yield place


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Tests that start nodes take seconds each: they are not of the fast tier."""
    here = Path(__file__).parent
    for item in items:
        if item.path.is_relative_to(here):
            item.add_marker(pytest.mark.slow)
