"""A live twin reports its tolerance and gives it up under overload, so that all is reproduced."""

import itertools
import subprocess

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from planetary_twin_msgs.msg import GearboxState, MeshWaveform, OperatingPoint

import planetary_twin_py as pt
from planetary_twin_py.run.quality_control import HALVINGS, Setting
from planetary_twin_py.run.tolerance import LADDER

from ...conftest import Start
from ...peer import LATCHED, LONG, TWIN
from ...reported import assert_simulated_again, figures, reported_settings

NODE = f"{TWIN}/simulation"
SAMPLE_RATE = 50e3
LOW_RATE = 5000
FLOOR = SAMPLE_RATE / 2**HALVINGS
# Its first windows last some hundred times longer than there is at 100 times real time.
MOVING_AXES = "{base: floating_sun, operating_point: {input_speed: 1000.0}}"


def test_an_overloaded_twin_degrades_in_order_and_reports_it(peer, start, tmp_path):
    scene = tmp_path / "moving_axes.yaml"
    scene.write_text(MOVING_AXES)
    given = {"rate_factor": 100, "publish_rate": 10, "tolerance": 0.0}
    process = start("planetary_twin.simulation", autostart="false", scene=scene, **given)
    waves = peer.listen(MeshWaveform, f"{TWIN}/mesh_waveform", 1000)
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state", 1000)
    points = peer.listen(OperatingPoint, f"{TWIN}/operating_point", LATCHED)
    reports = peer.listen(DiagnosticArray, "/diagnostics")
    peer.change_state(NODE, "configure")
    peer.change_state(NODE, "activate")
    peer.until(lambda: len(reports) >= 2 and len(waves) > 20)
    peer.change_state(NODE, "deactivate")
    peer.until(lambda: figures(reports)["state"] == "stopped")
    process.terminate()
    _, log = process.communicate(timeout=LONG)

    reported = figures(reports)
    settings = list(reported_settings(reported).values())
    # Once mesh cycles repeat, a fast machine may improve the waveform again.
    down = settings[: settings.index(Setting(LADDER[0], FLOOR)) + 1]
    given_up = [(-setting.tolerance, setting.sample_rate) for setting in down]
    assert given_up == sorted(given_up, reverse=True)
    assert int(reported["tolerance_changes"]) >= 1 and int(reported["sample_rate_changes"]) >= 1
    assert "thinned" in {figures([report]).get("waveform") for report in reports}
    assert int(reported["overruns"]) > 0
    # The first report may precede the end of the first interval.
    late = [s for report in reports for s in report.status if " behind: " in s.message]
    assert late and {s.level for s in late} <= {DiagnosticStatus.WARN, DiagnosticStatus.ERROR}
    assert log.count("waveform at") == len(settings) - 1
    assert 1 <= log.count("behind: ") <= len(reports)

    by_number = {wave.sequence: wave for wave in waves}
    pairs = [(state, by_number[state.sequence]) for state in states if state.sequence in by_number]
    assert len(pairs) > len(waves) - 3  # the first messages of the two topics may differ
    for state, wave in pairs:
        begin, end = state.simulated_time - state.interval, state.simulated_time
        numbers = [round(time / wave.sample_period, 6) for time in (begin, end)]
        assert round(wave.start_time / wave.sample_period, 6) == numbers[0] // 1 + 1
        assert wave.samples == numbers[1] // 1 - numbers[0] // 1
    for before, after in itertools.pairwise(waves):
        assert after.sequence == before.sequence + 1
    assert_simulated_again(pt.load_scene(scene), waves, points, reported, SAMPLE_RATE)


@pytest.fixture
def simulation(start: Start) -> subprocess.Popen[str]:
    """A simulation that waits for activation, so that a peer receives its first message."""
    given = {"autostart": "false", "sample_rate": LOW_RATE, "tolerance": 0.0}
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
    assert_simulated_again(pt.load_scene("paper"), waves, points, reported, LOW_RATE)
