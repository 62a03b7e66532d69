"""The process of a node: signals, threads of NumPy, and a log folder without a home."""

import itertools
import os
import signal
import subprocess
import sys
import time

import pytest
from planetary_twin.process.environment import choose_log_folder

WORK = """
import time
from planetary_twin.process.signals import SIGNALS
SIGNALS.install()
print("ready", flush=True)
end = time.monotonic() + 2.0
while time.monotonic() < end:
    pass
SIGNALS.ignore()
print(SIGNALS.received, flush=True)
"""


def test_thousands_of_signals_interrupt_one_another():
    with subprocess.Popen([sys.executable, "-c", WORK], stdout=subprocess.PIPE, text=True) as child:
        assert child.stdout
        assert child.stdout.readline() == "ready\n"
        end = time.monotonic() + 1.5
        for number in itertools.cycle((signal.SIGINT, signal.SIGTERM)):
            child.send_signal(number)
            if time.monotonic() > end:
                break
        try:
            shown, _ = child.communicate(timeout=60)
        finally:
            child.kill()
    assert shown == "True\n" and child.returncode == 0


NUMPY_ALONE = """
import os, types
from planetary_twin import executables

def load(name, package):
    import numpy
    return types.SimpleNamespace(main=lambda: len(os.listdir("/proc/self/task")))

executables.import_module = load
print(executables.run("follower.node"))
"""


def test_numpy_starts_no_threads_in_a_node():
    done = subprocess.run(
        [sys.executable, "-c", NUMPY_ALONE], capture_output=True, text=True, check=True
    )
    assert int(done.stdout) == 1


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
