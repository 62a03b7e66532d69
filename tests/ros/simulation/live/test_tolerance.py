"""A live twin reports its tolerance exactly, so that its messages can be reproduced."""

from __future__ import annotations

import subprocess

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from planetary_twin_msgs.msg import MeshWaveform, OperatingPoint

import planetary_twin_py as pt

from ...conftest import Start
from ...peer import LATCHED, TWIN
from ...reported import assert_simulated_again, figures, reported_settings

NODE = f"{TWIN}/simulation"
SAMPLE_RATE = 5000


@pytest.fixture
def simulation(start: Start) -> subprocess.Popen[str]:
    """A simulation that waits for activation, so that a peer receives its first message."""
    given = {"autostart": "false", "sample_rate": SAMPLE_RATE, "tolerance": 0.0}
    return start("planetary_twin.simulation", **given)


def test_reports_reproduce_published_waveforms_bit_for_bit(peer, simulation):
    waves = peer.listen(MeshWaveform, f"{TWIN}/mesh_waveform", 1000)
    points = peer.listen(OperatingPoint, f"{TWIN}/operating_point", LATCHED)
    reports = peer.listen(DiagnosticArray, "/diagnostics")
    peer.change_state(NODE, "configure")
    peer.change_state(NODE, "activate")
    peer.until(lambda: waves and waves[-1].start_time > 1.2)  # long enough to choose a tolerance
    assert figures(reports)["tolerance_choice"] == "automatic"
    assert peer.set(NODE, backlash=3e-7).successful
    assert peer.set(NODE, tolerance=2e-5).successful
    peer.until(lambda: figures(reports).get("tolerance") == "2e-05")
    assert figures(reports)["tolerance_choice"] == "fixed"
    assert peer.set(NODE, tolerance=0, input_speed=200, atomically=True).successful
    peer.until(lambda: figures(reports)["tolerance_choice"] == "automatic")
    peer.change_state(NODE, "deactivate")
    peer.until(lambda: figures(reports)["state"] == "stopped")

    reported = figures(reports)
    tolerances = [setting.tolerance for setting in reported_settings(reported).values()]
    assert 2e-5 in tolerances
    assert tolerances[-1] == float(reported["tolerance"])
    assert len(points) == 3
    assert len(waves) > 100
    assert_simulated_again(pt.load_scene("paper"), waves, points, reported, SAMPLE_RATE)
