"""Every node is found where `ros2 run` and `ros2 launch` look for it, and nowhere on the path."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from tiers import first

PACKAGE = Path(__file__).parents[2] / "ros_ws/src/planetary_twin"
SCRIPTS = PACKAGE / "scripts"
FOLDER = Path(sys.prefix, "lib/planetary_twin")


def test_executables_are_those_of_the_package() -> None:
    found = {path.name for path in FOLDER.iterdir()}
    assert found == {path.name for path in SCRIPTS.iterdir()}
    assert {"simulation", "logger", "replay", "twin"} <= found


@pytest.mark.parametrize("name", first(1, sorted(path.name for path in SCRIPTS.iterdir())))
def test_executables_run_with_their_interpreter(name: str) -> None:
    unknown = [FOLDER / name, "--ros-args", "--no-such-option"]
    done = subprocess.run(
        unknown, env={"PATH": "/usr/bin:/bin"}, capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 1
    assert "--no-such-option" in done.stderr and "Traceback" not in done.stderr


def test_no_program_of_the_system_is_hidden() -> None:
    """`logger` is one of them; the names of the other nodes may be."""
    on_the_path = {path.name for path in Path(sys.prefix, "bin").iterdir()}
    assert not on_the_path & {path.name for path in FOLDER.iterdir()}
    assert "planetary-twin" in on_the_path


@pytest.mark.parametrize("name", ["twin", "follow"])
def test_the_launch_file_starts_executables_that_exist(name: str) -> None:
    launch = PACKAGE / f"launch/{name}.launch.py"
    started = re.findall(r'_node\(\s*"(\w+)"', launch.read_text(encoding="utf-8"))
    assert started
    assert set(started) <= {path.name for path in FOLDER.iterdir()}
    assert all(os.access(path, os.X_OK) for path in FOLDER.iterdir())
