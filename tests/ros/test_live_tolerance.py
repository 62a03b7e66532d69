"""A live twin tells its tolerance so exactly that what it published can be simulated again."""

from __future__ import annotations

import subprocess

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from planetary_twin_msgs.msg import MeshWaveform, OperatingPoint

import planetary_twin_py as pt

from .conftest import Start
from .peer import LATCHED, TWIN, Peer

NODE = f"{TWIN}/simulation"
SAMPLE_RATE = 5000
SINCE = "tolerance_from."


@pytest.fixture
def simulation(start: Start) -> subprocess.Popen[str]:
    """A simulation that waits to be activated, so that a peer hears it from its first message."""
    options = ("-p", "autostart:=false", "-p", f"sample_rate:={SAMPLE_RATE}")
    return start("planetary_twin.simulation", "--ros-args", *options)


def change_state(peer: Peer, label: str) -> None:
    request = ChangeState.Request(transition=Transition(label=label))
    peer.until(lambda: peer.call(ChangeState, f"{NODE}/change_state", request).success, 120.0)


def figures(reports: list[DiagnosticArray]) -> dict[str, str]:
    """All that the reports have told, the newest where they repeat."""
    return {item.key: item.value for report in reports for item in report.status[0].values}


def simulated_again(
    points: list[OperatingPoint], tolerances: dict[float, float], end: float
) -> np.ndarray:
    """Samples of all meshes from the told changes alone, in float32 as published."""
    changes = {point.simulated_time: point for point in points}
    values = {name: getattr(points[0], name) for name in pt.TUNABLES}
    twin = pt.Twin(pt.load_scene("paper").replace(**values), SAMPLE_RATE, tolerances[0.0])
    parts = []
    for instant in sorted({*changes, *tolerances, end} - {0.0}):
        parts.append(twin.advance(instant - twin.time).waveform.dte)
        if instant in changes:
            twin.set(**{name: getattr(changes[instant], name) for name in pt.TUNABLES})
        if instant in tolerances:
            twin.set_tolerance(tolerances[instant])
    return np.vstack(parts).astype(np.float32)


def test_what_was_published_is_simulated_again_bit_by_bit_from_what_was_told(
    peer: Peer, simulation: subprocess.Popen[str]
) -> None:
    waves = peer.listen(MeshWaveform, f"{TWIN}/mesh_waveform", 1000)
    points = peer.listen(OperatingPoint, f"{TWIN}/operating_point", LATCHED)
    reports = peer.listen(DiagnosticArray, "/diagnostics")
    change_state(peer, "configure")
    change_state(peer, "activate")
    peer.until(lambda: waves and waves[-1].start_time > 1.2)  # time enough to choose
    assert figures(reports)["tolerance_choice"] == "automatic"
    assert peer.set(NODE, backlash=3e-7).successful
    assert peer.set(NODE, tolerance=2e-5).successful
    peer.until(lambda: figures(reports).get("tolerance") == "2e-05")
    assert figures(reports)["tolerance_choice"] == "fixed"
    assert peer.set(NODE, tolerance=0, input_speed=200, atomically=True).successful
    peer.until(lambda: figures(reports)["tolerance_choice"] == "automatic")
    change_state(peer, "deactivate")
    peer.until(lambda: figures(reports)["state"] == "stopped")

    told = figures(reports)
    tolerances = {
        float(key.removeprefix(SINCE)): float(value)
        for key, value in told.items()
        if key.startswith(SINCE)
    }
    assert 2e-5 in tolerances.values()
    assert tolerances[max(tolerances)] == float(told["tolerance"])
    assert len(points) == 3
    again = simulated_again(points, tolerances, float(told["simulated_time"]))
    assert len(waves) > 100
    for wave in waves:
        first = round(wave.start_time * SAMPLE_RATE) - 1
        published = np.array(wave.dte).reshape(2 * wave.planets, wave.samples).T
        assert np.array_equal(again[first : first + wave.samples], published.astype(np.float32))
