"""Nodes in one process and twins side by side: nothing is lost, and they end together or warn."""

import contextlib
import signal
import subprocess

import pytest
from planetary_twin_msgs.msg import GearboxState, RecorderStatus

from .peer import LONG, TWIN
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
    ended(twin)
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


def test_two_twins_of_one_name_both_warn_and_give_the_remedy(peer, start):
    twins = [start("planetary_twin.simulation") for _ in range(2)]
    own = ("simulation", TWIN)
    peer.until(lambda: peer.node.get_node_names_and_namespaces().count(own) == 2)
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    peer.until(lambda: len(states) > 600)  # three seconds of both
    for twin in twins:
        twin.terminate()
    for twin in twins:
        _, log = twin.communicate(timeout=LONG)
        warned = [line for line in log.splitlines() if "another node is named" in line]
        assert len(warned) == 1 and "[WARN]" in warned[0]
        assert f"{TWIN}/simulation" in warned[0] and "-r __ns:=" in warned[0]
        assert "gearbox_state has another publisher" in log
