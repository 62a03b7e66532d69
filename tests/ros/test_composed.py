"""Simulation and logger share a process without losing messages, and end together."""

from __future__ import annotations

import contextlib
import signal
import subprocess

import pytest
from planetary_twin_msgs.msg import GearboxState, RecorderStatus

from .peer import TWIN
from .programs import ended
from .recordings import counts
from .reported import recorded

STATES = f"{TWIN}/gearbox_state"


def test_every_message_is_recorded_until_signals_end_it(peer, start, tmp_path):
    twin = start("planetary_twin.twin", name="bag")
    states = peer.listen(GearboxState, STATES, 1000)
    status = peer.listen(RecorderStatus, f"{TWIN}/logger/status")
    peer.until(lambda: len(states) > 100 and status and STATES in status[-1].topics)
    reported = len(status)
    peer.until(lambda: len(status) > reported + 1)
    received = recorded(status, STATES)
    assert list(status[-1].lost) == [0] * len(status[-1].topics)
    while twin.poll() is None:  # the file is finished, however many signals the user sends
        twin.send_signal(signal.SIGINT)
        with contextlib.suppress(subprocess.TimeoutExpired):
            twin.wait(0.01)
    _, errors = twin.communicate()
    assert twin.returncode == 0, errors
    assert "Traceback" not in errors
    assert counts(tmp_path / "recordings/bag")[STATES] >= received > 100


@pytest.mark.parametrize(
    ("setting", "reason"),
    [
        ("directory:=file/below", "logger: directory = file/below: "),
        ("input_torque:=1e9", "simulation: "),
    ],
)
def test_a_node_that_cannot_start_ends_both_with_one_line(start, tmp_path, setting, reason):
    (tmp_path / "file").write_text("in the way")
    twin = start("planetary_twin.twin", "--ros-args", "-p", setting)
    errors = ended(twin, 1)
    lines = [line for line in errors.strip().splitlines() if "[INFO]" not in line]
    assert len(lines) == 1 and lines[0].startswith(reason), errors
    assert setting.partition(":=")[0] in lines[0]
