"""Nodes and commands start without a home folder."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest
from planetary_twin.process.environment import choose_log_folder


def test_a_node_without_home_says_only_what_is_wrong(domain, tmp_path):
    environment = {k: v for k, v in os.environ.items() if k not in ("HOME", "ROS_HOME")}
    environment["TMPDIR"] = str(tmp_path)
    done = subprocess.run(
        [sys.executable, "-m", "planetary_twin.simulation", "--ros-args", "-p", "scene:=none"],
        env=environment | {"ROS_LOG_DIR": ""},
        capture_output=True,
        text=True,
        timeout=120,
        cwd=tmp_path,
    )
    assert done.returncode == 1
    assert done.stderr.startswith("simulation: ") and len(done.stderr.splitlines()) == 1
    assert list(tmp_path.glob("ros_log_*/*.log"))


@pytest.mark.parametrize(
    ("given", "log_folder"),
    [
        ({"HOME": "."}, None),
        ({"HOME": ".", "ROS_LOG_DIR": "logs"}, "logs"),
        ({"ROS_HOME": "ros"}, None),
        ({"HOME": "/nonexistent"}, f"/tmp/ros_log_{os.getuid()}"),
    ],
)
def test_a_folder_of_the_user_is_kept(monkeypatch, given, log_folder):
    for name in ("HOME", "ROS_HOME", "ROS_LOG_DIR"):
        monkeypatch.delenv(name, raising=False)
    for name, value in given.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr("tempfile.tempdir", "/tmp")
    choose_log_folder()
    assert os.environ.get("ROS_LOG_DIR") == log_folder
