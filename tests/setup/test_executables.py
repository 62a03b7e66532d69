"""Every node is found where `ros2 run` and `ros2 launch` look for it."""

import os
import re
import sys
from importlib.metadata import distribution
from pathlib import Path

LAUNCH = Path(__file__).parents[2] / "ros_ws/src/planetary_twin/launch/twin.launch.py"
FOLDER = Path(sys.prefix, "lib/planetary_twin")


def test_executables_are_those_that_the_package_declares() -> None:
    declared = distribution("planetary_twin").entry_points.select(group="console_scripts")
    found = {path.name for path in FOLDER.iterdir()}
    assert found == {script.name for script in declared}
    assert all(os.access(path, os.X_OK) for path in FOLDER.iterdir())


def test_the_launch_file_starts_executables_that_exist() -> None:
    started = re.findall(r'_node\("(\w+)"', LAUNCH.read_text(encoding="utf-8"))
    assert started
    assert set(started) <= {path.name for path in FOLDER.iterdir()}
