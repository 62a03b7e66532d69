"""A diverging twin stops with an error, and can be started again."""

import subprocess
import sys
from pathlib import Path

import pytest
from diagnostic_msgs.msg import DiagnosticStatus
from planetary_twin_msgs.msg import GearboxState, RecorderStatus
from planetary_twin_msgs.srv import SetOperatingPoint
from std_srvs.srv import SetBool, Trigger

from planetary_twin_py.recording.runs.verify import verify

from ...peer import TWIN
from ...programs import ended
from ...reported import figures, listen_to_reports
from ...running.conftest import COMMAND

NODE = f"{TWIN}/simulation"
# 63 N m press the teeth 0.94 mm into one another, 300 N m 4.5 mm; a base pitch is 2.34 mm.
SOFT = "base: paper\nmesh: {sun_planet_stiffness: 2e6 N/m, planet_ring_stiffness: 2e6 N/m}\n"


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    """A gearbox with teeth of rubber."""
    path = tmp_path / "soft.yaml"
    path.write_text(SOFT)
    return path


def test_a_runaway_pauses_the_twin_with_an_error(peer, start, scene, tmp_path):
    logger = start("planetary_twin.logger", name="bag")
    status = peer.listen(RecorderStatus, f"{TWIN}/logger/status")
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state", 1000)
    reports = listen_to_reports(peer)
    start("planetary_twin.simulation", scene=scene)
    peer.until(lambda: status and states and states[-1].simulated_time > 0.5, 120.0)
    peer.set(NODE, input_torque=300.0)
    peer.until(lambda: reports and figures(reports)["state"] == "failed")
    assert reports[-1].status[0].level == DiagnosticStatus.ERROR
    assert "base pitch" in reports[-1].status[0].message
    last = states[-1].simulated_time
    assert float(figures(reports)["simulated_time"]) == pytest.approx(last, abs=1e-6)

    paused = peer.call(SetBool, f"{NODE}/pause", SetBool.Request(data=False))
    request = SetOperatingPoint.Request(names=["input_torque"], values=[63.0])
    answer = peer.call(SetOperatingPoint, f"{NODE}/set_operating_point", request)
    for refused in (paused, answer):
        assert not refused.success
        assert "base pitch" in refused.message
        assert "~/reset" in refused.message
    assert peer.state(NODE) == "active"

    assert peer.call(Trigger, f"{NODE}/reset", Trigger.Request()).success
    peer.until(lambda: figures(reports)["state"] == "running" and states[-1].simulated_time > 0.5)
    logger.terminate()
    ended(logger)
    assert verify(tmp_path / "recordings/bag", TWIN).first_difference is None


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ("input_torque: 300 N m", "refuses to configure: the run stops near 0 s"),
        ("torque_ripple: 300 N m", "the recording is in"),
    ],
)
def test_a_run_that_fails_says_why_and_names_its_recording(domain, scene, tmp_path, change, reason):
    scene.write_text(f"{SOFT}operating_point: {{{change}}}\n")
    options = ("--duration", "3", "--no-tour", "--record", "bag")
    run = subprocess.run(
        [sys.executable, *COMMAND, str(scene), *options],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
        timeout=120.0,
    )
    assert run.returncode == 1
    assert "base pitch" in run.stderr
    assert reason in run.stderr
