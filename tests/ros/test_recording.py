"""The logger finishes its file at any end, and counts every message."""

from __future__ import annotations

import signal
import subprocess
from pathlib import Path

import pytest
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from planetary_twin_msgs.msg import GearboxState, RecorderStatus

from .conftest import Start
from .peer import LONG, TWIN, Peer
from .recordings import counts, unfinished_states
from .reported import figures, listen_to_reports

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
    return start("planetary_twin.logger", "--ros-args", "-p", "name:=bag")


def _record(peer: Peer, start: Start, messages: int = 100) -> list[GearboxState]:
    """Start a simulation and wait until the logger has that many of its states."""
    start("planetary_twin.simulation")
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state", 1000)
    status = peer.listen(RecorderStatus, f"{TWIN}/logger/status")
    topic = f"{TWIN}/gearbox_state"
    peer.until(
        lambda: (
            states
            and status
            and topic in status[-1].topics
            and status[-1].recorded[list(status[-1].topics).index(topic)] >= messages
        ),
        120.0,
    )
    return states


@pytest.mark.parametrize(
    "number", [signal.SIGINT, pytest.param(signal.SIGTERM, marks=pytest.mark.exhaustive)]
)
def test_a_signal_finishes_the_file(
    peer: Peer, start: Start, logger: subprocess.Popen[str], tmp_path: Path, number: int
) -> None:
    _record(peer, start)
    logger.send_signal(number)
    _, errors = logger.communicate(timeout=LONG)
    assert logger.returncode == 0
    assert "Traceback" not in errors
    recorded = counts(tmp_path / "recordings/bag")
    assert set(recorded) == TOPICS
    assert recorded[f"{TWIN}/gearbox_state"] >= 100


def test_sigkill_loses_nothing_older_than_the_flush_period(
    peer: Peer, start: Start, logger: subprocess.Popen[str], tmp_path: Path
) -> None:
    states = _record(peer, start, 200)
    received = states[-1].simulated_time
    # The thread that flushes also publishes the status once a second.
    assert peer.get(f"{TWIN}/logger", "flush_period") <= 0.5
    status = peer.listen(RecorderStatus, f"{TWIN}/logger/status")
    peer.until(lambda: len(status) >= 3)
    logger.kill()
    logger.wait(LONG)
    kept = unfinished_states(tmp_path / "recordings/bag/bag_0.mcap")
    assert kept[-1].simulated_time >= received
    first = kept[0].sequence
    assert [state.sequence for state in kept] == list(range(first, first + len(kept)))


def test_recorded_plus_lost_equals_published(
    peer: Peer, start: Start, logger: subprocess.Popen[str], tmp_path: Path
) -> None:
    status = peer.listen(RecorderStatus, f"{TWIN}/logger/status")
    reports = listen_to_reports(peer)
    _record(peer, start)
    stop = ChangeState.Request(transition=Transition(label="deactivate"))
    assert peer.call(ChangeState, f"{TWIN}/simulation/change_state", stop).success

    def published() -> dict[str, int]:
        if not reports:  # reports arrive once a second
            return {}
        values = figures(reports[-1:])
        if values.get("state") != "stopped":
            return {}
        prefix = "published."
        return {k[len(prefix) :]: int(v) for k, v in values.items() if k.startswith(prefix)}

    def complete() -> bool:
        last = status[-1]
        totals = zip(last.topics, last.recorded, last.lost, strict=True)
        return {name: recorded + lost for name, recorded, lost in totals} == published()

    peer.until(published)
    peer.until(complete)
    assert set(published()) == TOPICS
    lost = dict(zip(status[-1].topics, status[-1].lost, strict=True))
    logger.terminate()
    assert logger.wait(LONG) == 0
    recorded = counts(tmp_path / "recordings/bag")
    assert {name: recorded[name] + lost[name] for name in recorded} == published()


def test_an_existing_recording_is_refused_in_one_line(
    start: Start, logger: subprocess.Popen[str], tmp_path: Path, peer: Peer
) -> None:
    peer.until(lambda: (tmp_path / "recordings/bag").exists())
    _refused(start("planetary_twin.logger", "--ros-args", "-p", "name:=bag"), "bag exists")


def test_a_folder_that_cannot_be_created_ends_in_one_line(start: Start, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    process = start("planetary_twin.logger", "--ros-args", "-p", f"directory:={tmp_path}/file/x")
    _refused(process, "Not a directory")


def _refused(process: subprocess.Popen[str], reason: str) -> None:
    _, errors = process.communicate(timeout=LONG)
    assert process.returncode == 1
    assert len(errors.strip().splitlines()) == 1
    assert reason in errors
    assert errors.startswith("logger: ")


@pytest.mark.exhaustive
def test_two_twins_run_side_by_side(peer: Peer, start: Start, tmp_path: Path) -> None:
    for name in ("left", "right"):
        place = ("--ros-args", "-r", f"__ns:=/{name}")
        start("planetary_twin.logger", *place, "-p", f"name:={name}")
        start("planetary_twin.simulation", *place)
    received = {
        name: peer.listen(GearboxState, f"/{name}/gearbox_state") for name in ("left", "right")
    }
    peer.until(lambda: all(received.values()))
    assert peer.set("/left/simulation", lambda_ratio=2).successful
    peer.until(lambda: abs(received["left"][-1].sun_planet_lambda_ratio[0] - 2.0) < 1e-6)
    assert abs(received["right"][-1].sun_planet_lambda_ratio[0] - 1.0) < 1e-6


def test_the_simulation_ends_on_a_signal_without_a_traceback(peer: Peer, start: Start) -> None:
    for number in (signal.SIGINT, signal.SIGTERM):
        process = start("planetary_twin.simulation")
        states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
        peer.until(lambda received=states: len(received) > 10)
        process.send_signal(number)
        _, errors = process.communicate(timeout=LONG)
        assert process.returncode == 0, errors
        assert "Traceback" not in errors


def test_a_logger_that_stalls_briefly_misses_nothing(peer: Peer, start: Start) -> None:
    logger = start("planetary_twin.logger", "--ros-args", "-p", "name:=bag")
    # Slow, so that a publisher keeps all messages of the pause on a busy machine.
    slow = ("-p", "wait_for:=logger", "-p", "rate_factor:=0.25")
    start("planetary_twin.simulation", "--ros-args", *slow)
    status = peer.listen(RecorderStatus, f"{TWIN}/logger/status")
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    peer.until(lambda: states and status)
    for _ in range(3):
        count = len(states)
        logger.send_signal(signal.SIGSTOP)
        peer.until(lambda count=count: len(states) > count + 30)
        logger.send_signal(signal.SIGCONT)
        peer.until(lambda count=count: len(states) > count + 50)
    reported = len(status)
    peer.until(lambda: len(status) > reported + 1)
    assert dict(zip(status[-1].topics, status[-1].lost, strict=True)) == dict.fromkeys(TOPICS, 0)
