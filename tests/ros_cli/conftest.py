"""The `ros2` command itself against this project's nodes.

Skipped where there is no `ros2`. With a full ROS 2 Jazzy, after building the workspace:

    source /opt/ros/jazzy/setup.bash
    source ros_ws/install/setup.bash
    pytest tests/ros_cli

in the Python environment that holds `planetary_twin_py`. Nothing here imports ROS: what `ros2`
prints is all that is read, so any installation of it can be tested.
"""

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from domains import private_domain

from .command import Ros2


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Commands take a second each; and without `ros2` there is nothing to test."""
    missing = pytest.mark.skip(reason="there is no ros2 command: see tests/ros_cli/conftest.py")
    for item in items:
        if item.path.is_relative_to(Path(__file__).parent):
            item.add_marker(pytest.mark.slow)
            if shutil.which("ros2") is None:
                item.add_marker(missing)


@pytest.fixture(scope="module")
def ros2(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Ros2]:
    """The command on a domain of its own; ends what it has started, and its daemon."""
    with private_domain() as number:
        command = Ros2(number, tmp_path_factory.mktemp("cli"))
        yield command
        for process in command.started:
            command.interrupt(process)
        command("daemon", "stop")


@pytest.fixture(scope="module")
def twin(ros2: Ros2) -> str:
    """The name of a simulation that runs."""
    ros2.start("run", "planetary_twin", "simulation")
    name = "/planetary_twin/simulation"
    ros2.until("active [3]", "lifecycle", "get", name)
    return name
