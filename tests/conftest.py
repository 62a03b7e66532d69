"""For all tests: real DDS, on a domain of this run's own and on this machine alone; Ctrl-C."""

import os
import re
import signal
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest
from domains import private_domain

ROOT = Path(__file__).parents[1]
TESTS = ROOT / "tests"

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


def pytest_configure(config: pytest.Config) -> None:
    """Let each worker read the tests from another folder on.

    Each compiles what it reads first, and finds the rest compiled by the others.
    """
    worker = getattr(config, "workerinput", None)
    if worker and config.args_source is pytest.Config.ArgsSource.TESTPATHS:
        parts = sorted({str(path.parent) for path in TESTS.glob("*/**/test_*.py")})
        parts += sorted(map(str, TESTS.glob("test_*.py")))
        begin = len(parts) * int(worker["workerid"].removeprefix("gw")) // worker["workercount"]
        config.args = parts[begin:] + parts[:begin]


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Leave files unread that have no test of the one tier that is wanted: most have none."""
    tier = re.match("exhaustive|release", config.option.markexpr)
    if not tier or not collection_path.match("test_*.py"):
        return None
    text = collection_path.read_text("utf-8")
    return True if tier[0] not in text and "tiers" not in text else None


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Put the longest files, which compile or run pages, first; spread tests/ros, which waits.

    With the order of pytest-xdist, by number of tests, the slowest few would come last.
    """
    files: dict[Path, list[pytest.Item]] = {}
    for item in items:
        files.setdefault(item.path, []).append(item)
    order = []
    for waits in (True, False):
        group = sorted(file for file in files if file.is_relative_to(TESTS / "ros") == waits)
        order += [((place + 0.5) / len(group), file) for place, file in enumerate(group)]
    longest = TESTS / "setup", TESTS / "docs"
    order.sort(key=lambda each: (not any(map(each[1].is_relative_to, longest)), each[0]))
    items[:] = [item for _, file in order for item in files[file]]


@pytest.fixture
def domain(monkeypatch: pytest.MonkeyPatch) -> Iterator[int]:
    """A domain for this test alone, also in the environment of what it starts."""
    with private_domain() as number:
        monkeypatch.setenv("ROS_DOMAIN_ID", str(number))
        yield number
