"""Simulation and logger share a process without losing a message, and end as one."""

from __future__ import annotations

import contextlib
import signal
import subprocess
from pathlib import Path

import pytest
from planetary_twin_msgs.msg import GearboxState, RecorderStatus

from .conftest import Start
from .peer import LONG, TWIN, Peer
from .recordings import counts

STATES = f"{TWIN}/gearbox_state"


def test_what_is_published_is_recorded_until_however_many_signals(
    peer: Peer, start: Start, tmp_path: Path
) -> None:
    twin = start("planetary_twin.composed", "--ros-args", "-p", "name:=bag")
    states = peer.listen(GearboxState, STATES, 1000)
    status = peer.listen(RecorderStatus, f"{TWIN}/logger/status")
    peer.until(lambda: len(states) > 100 and status and STATES in status[-1].topics)
    told = len(status)
    peer.until(lambda: len(status) > told + 1)
    heard = status[-1].recorded[list(status[-1].topics).index(STATES)]
    assert list(status[-1].lost) == [0] * len(status[-1].topics)
    while twin.poll() is None:  # the file is finished no matter how impatient the user is
        twin.send_signal(signal.SIGINT)
        with contextlib.suppress(subprocess.TimeoutExpired):
            twin.wait(0.01)
    _, errors = twin.communicate()
    assert twin.returncode == 0, errors
    assert "Traceback" not in errors
    assert counts(tmp_path / "recordings/bag")[STATES] >= heard > 100


@pytest.mark.parametrize(
    ("setting", "told"),
    [
        ("directory:=file/below", "logger: directory = file/below: "),
        ("input_torque:=1e9", "simulation: "),
    ],
)
def test_what_keeps_one_node_from_starting_ends_both_in_one_line(
    start: Start, tmp_path: Path, setting: str, told: str
) -> None:
    (tmp_path / "file").write_text("in the way")
    twin = start("planetary_twin.composed", "--ros-args", "-p", setting)
    _, errors = twin.communicate(timeout=LONG)
    assert twin.returncode == 1
    lines = [line for line in errors.strip().splitlines() if "[INFO]" not in line]
    assert len(lines) == 1 and lines[0].startswith(told), errors
    assert setting.partition(":=")[0] in lines[0]
