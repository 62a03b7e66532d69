"""The logger finishes its file at any end, and counts every message."""

from __future__ import annotations

import signal
import subprocess

import pytest
from planetary_twin_msgs.msg import GearboxState, RecorderStatus

from ..conftest import Start
from ..peer import TWIN, Peer
from ..programs import ended, refuses
from ..recordings import counts
from ..reported import recorded

TOPICS = {
    "/diagnostics",
    "/tf",
    *(f"{TWIN}/{name}" for name in ("gearbox_state", "joint_states", "mesh_waveform")),
    *(f"{TWIN}/{name}" for name in ("operating_point", "robot_description", "run_origin")),
    f"{TWIN}/applied_commands",
}


@pytest.fixture
def logger(start: Start) -> subprocess.Popen[str]:
    """A logger that records into recordings/bag."""
    return start("planetary_twin.logger", name="bag")


def _record(peer: Peer, start: Start, messages: int = 100) -> list[GearboxState]:
    """Start a simulation and wait until the logger has that many of its states."""
    start("planetary_twin.simulation")
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state", 1000)
    status = peer.listen(RecorderStatus, f"{TWIN}/logger/status")
    peer.until(lambda: states and recorded(status, f"{TWIN}/gearbox_state") >= messages)
    return states


def test_a_signal_finishes_the_file(peer, start, logger, tmp_path):
    _record(peer, start)
    logger.send_signal(signal.SIGINT)
    ended(logger)
    recorded = counts(tmp_path / "recordings/bag")
    assert set(recorded) == TOPICS
    assert recorded[f"{TWIN}/gearbox_state"] >= 100


def test_an_existing_recording_is_refused_in_one_line(start, logger, tmp_path, peer):
    peer.until(lambda: (tmp_path / "recordings/bag").exists())
    line = refuses(start("planetary_twin.logger", name="bag"), "bag exists")
    assert line.startswith("logger: ")
