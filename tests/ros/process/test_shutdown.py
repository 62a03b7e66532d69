"""A node ends cleanly at any signal and during any work, and its peers continue."""

import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
import rclpy
from planetary_twin.base.lifecycle_node import shut_down
from planetary_twin_msgs.msg import GearboxState, RecorderStatus
from rclpy.context import Context
from std_srvs.srv import SetBool
from tiers import first

from ..conftest import Start
from ..peer import TWIN, Peer
from ..processes import holding
from ..programs import outcome
from ..recordings import counts
from ..reported import recorded

NODE = f"{TWIN}/simulation"
STATES = f"{TWIN}/gearbox_state"
TOPICS = {
    "/diagnostics",
    "/tf",
    *(f"{TWIN}/{name}" for name in ("gearbox_state", "joint_states", "mesh_waveform")),
    *(f"{TWIN}/{name}" for name in ("operating_point", "robot_description", "run_origin")),
    f"{TWIN}/applied_commands",
}
QUICK = 60.0  # [s] on a busy machine; shorter than an interval, a step or a build


def ended_well(process: subprocess.Popen[str]) -> str:
    """Its output, after it has ended in time, with exit code 0 and no traceback."""
    return outcome(process, timeout=QUICK)[1]


def twice(process: subprocess.Popen[str], number: signal.Signals) -> None:
    """Send a signal twice, as a user who presses Ctrl-C twice."""
    process.send_signal(number)
    process.send_signal(number)


@pytest.fixture
def start(execute: Start) -> Start:
    """Start nodes as users do: the start and the end of the interpreter matter here."""
    return execute


def running(peer: Peer, start: Start, *options: str) -> subprocess.Popen[str]:
    """A simulation that publishes."""
    process = start("planetary_twin.simulation", *options)
    states = peer.listen(GearboxState, STATES)
    peer.until(lambda: states)
    return process


@pytest.mark.parametrize("name", first(1, ["simulation", "logger"]))
def test_a_signal_while_a_node_loads_ends_it_without_output(domain, tmp_path, name):
    for library in ("numpy", "_rclpy", "fastrtps"):
        for number in (signal.SIGINT, signal.SIGTERM):
            process = subprocess.Popen(
                [Path(sys.prefix, "lib/planetary_twin", name)],
                cwd=tmp_path,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                text=True,
            )
            deadline = time.monotonic() + 60.0
            while not holding(process.pid, library):
                assert time.monotonic() < deadline and process.poll() is None
            twice(process, number)
            ended_well(process)


def test_a_signal_ends_a_slow_or_paused_twin_without_delay(peer, start):
    slow = ("--ros-args", "-p", "rate_factor:=0.01", "-p", "publish_rate:=10.0")
    process = start("planetary_twin.simulation", *slow)
    client = peer.node.create_client(SetBool, f"{NODE}/pause")
    peer.until(client.service_is_ready)
    process.send_signal(signal.SIGINT)
    ended_well(process)
    paused = running(peer, start)
    assert peer.call(SetBool, f"{NODE}/pause", SetBool.Request(data=True)).success
    paused.send_signal(signal.SIGINT)
    ended_well(paused)


def test_both_nodes_end_on_one_ctrl_c(peer, start, tmp_path):
    logger = start("planetary_twin.logger", name="bag")
    status = peer.listen(RecorderStatus, f"{TWIN}/logger/status")
    simulation = running(peer, start, "--ros-args", "-p", "wait_for:=logger")
    peer.until(lambda: recorded(status, STATES) > 50)
    for process in (logger, simulation):  # as Ctrl-C reaches the group
        twice(process, signal.SIGINT)
    ended_well(simulation)
    assert "lost none" in ended_well(logger)
    found = counts(tmp_path / "recordings/bag")
    assert set(found) == TOPICS
    assert found[STATES] > 50


@pytest.mark.parametrize("faster", [True, False])
def test_a_faster_signal_is_no_failure_of_rcl(monkeypatch, faster):
    context = Context()
    rclpy.init(context=context)

    def refused(context: Context) -> None:
        if faster:
            context.try_shutdown()
        raise RuntimeError("rcl_shutdown failed")

    with monkeypatch.context() as patched:
        patched.setattr(rclpy, "try_shutdown", refused)
        if faster:
            shut_down(context)
        else:
            with pytest.raises(RuntimeError, match="rcl_shutdown failed"):
                shut_down(context)
    shut_down(context)
    assert not context.ok()
