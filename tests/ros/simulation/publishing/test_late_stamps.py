"""Stamps of a node whose process was stopped: late, or with a skip that a recording contains."""

import signal
import time

from planetary_twin_msgs.msg import GearboxState

from planetary_twin_py.recording.runs.info import read_info
from planetary_twin_py.recording.runs.schedule import read_runs
from planetary_twin_py.recording.runs.what_if import Branch, resimulate

from ...peer import LONG, TWIN
from ...programs import Program
from ...reported import check_verified, figures, listen_to_reports

STALL, LIMIT = 3.0, 1.0  # [s]


def stall(process: Program) -> None:
    process.send_signal(signal.SIGSTOP)
    time.sleep(STALL)  # the subject of the test
    process.send_signal(signal.SIGCONT)


def test_a_skip_bounds_the_lag_and_verifies(peer, start, tmp_path):
    logger = start("planetary_twin.logger", name="stalled")
    simulation = start("planetary_twin.simulation", wait_for="logger", max_lag=LIMIT)
    states, reports = peer.listen(GearboxState, f"{TWIN}/gearbox_state"), listen_to_reports(peer)
    peer.until(lambda: len(states) > 50)
    stall(simulation)
    peer.until(lambda: int(figures(reports).get("skips", 0)) > 0)
    assert float(figures(reports)["stamp_lag"]) <= LIMIT
    count = len(states)
    peer.until(lambda: len(states) > count + 50)
    peer.change_state(f"{TWIN}/simulation", "deactivate")  # its last report has every skip
    simulation.terminate()
    simulation.communicate(timeout=LONG)
    check_verified(logger, folder := tmp_path / "recordings/stalled")
    info = read_info(folder)
    assert info.skips >= 1
    assert info.skipped >= STALL - LIMIT
    (run,) = read_runs(folder, TWIN, [])
    stamps = [interval.stamp for interval in run.intervals]
    ends = [interval.end for interval in run.intervals]
    passed, simulated = (stamps[-1] - stamps[0]) * 1e-9, (ends[-1] - ends[0]) * 1e-12
    assert abs(passed - simulated - info.skipped) < LIMIT
    made = resimulate(folder, TWIN, Branch({"backlash": 3e-7}), tmp_path / "branch")
    (again,) = read_runs(made.file, TWIN, [])
    assert [interval.stamp for interval in again.intervals] == stamps
