"""For all tests: real DDS, on a domain of this run's own and on this machine alone; Ctrl-C."""

import os
import signal
from collections.abc import Iterator
from contextlib import ExitStack
from itertools import zip_longest
from pathlib import Path

import pytest
from domains import private_domain

ROOT = Path(__file__).parents[1]

# A shell has what it runs in the background ignore Ctrl-C, and so does all that starts from there.
signal.signal(signal.SIGINT, signal.default_int_handler)

# A worker of pytest-xdist has it; a test that needs a width sets it.
os.environ.pop("COLUMNS", None)

# Read when rclpy and the message classes are first imported; child processes inherit them. The
# domain is for what has none of its own, and held as long as this process lives.
_HELD = ExitStack()
os.environ["ROS_DOMAIN_ID"] = str(_HELD.enter_context(private_domain()))
# As `planetary-twin run` has it: nodes find one another at once, and none stumbles over what
# another that was killed has left in shared memory.
os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "SYSTEM_DEFAULT"
profile = ROOT / "ros_ws/src/planetary_twin/config/loopback.xml"
os.environ["FASTRTPS_DEFAULT_PROFILES_FILE"] = str(profile)
os.environ["RMW_FASTRTPS_USE_QOS_FROM_XML"] = "1"
os.environ["ROS_PYTHON_CHECK_FIELDS"] = "1"


# Folders whose tests start processes and wait for them.
WAITING = {"ros", "ros_cli", "cli", "view"}


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Let files that wait and files that compute take turns, so that none waits alone at the end.

    With the order of pytest-xdist, by number of tests, the slowest few would come last.
    """
    files: dict[bool, dict[Path, list[pytest.Item]]] = {True: {}, False: {}}
    for item in items:
        waits = not WAITING.isdisjoint(item.path.relative_to(ROOT).parts)
        files[waits].setdefault(item.path, []).append(item)
    turns = zip_longest(files[True].values(), files[False].values(), fillvalue=())
    items[:] = [item for turn in turns for file in turn for item in file]


@pytest.fixture
def domain(monkeypatch: pytest.MonkeyPatch) -> Iterator[int]:
    """A domain for this test alone, also in the environment of what it starts."""
    with private_domain() as number:
        monkeypatch.setenv("ROS_DOMAIN_ID", str(number))
        yield number
