"""A twin whose axes move publishes their motion, live and recorded."""

import signal
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticStatus
from domains import private_domain
from planetary_twin.clients.monitor import Monitor
from planetary_twin.simulation.diagnostics.intervals import ACCURACY, DYNAMICS
from planetary_twin_msgs.msg import AxesState, AxesWaveform, GearboxState, RecorderStatus
from rclpy.serialization import deserialize_message
from std_msgs.msg import String

import planetary_twin_py as pt
from planetary_twin_py.recording.runs.origin import read_origin
from planetary_twin_py.recording.runs.verify import verify
from planetary_twin_py.statics.load_sharing import load_sharing

from ...conftest import starting
from ...peer import LATCHED, LONG, TWIN, connected
from ...programs import Forked, ended
from ...recordings import counts, read_all
from ...reported import listen_to_reports, recorded, statuses

STATES = 100
SLOWLY = {"rate_factor": 0.5, "sample_rate": 10000.0, "tolerance": 0.001}


class Run(NamedTuple):
    """What a twin whose axes move has published, and its recording."""

    states: list[AxesState]
    gearbox: list[GearboxState]
    blocks: list[AxesWaveform]
    folder: Path
    table: str


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Run]:
    """
    A second of a twin with a floating sun, received over DDS and recorded.

    The twin waits for the recorder alone: the first messages may come before it knows the others.
    """
    place = tmp_path_factory.mktemp("axes")
    scene = place / "moving.yaml"
    scene.write_text("base: floating_sun\nname: moving\ndynamics: planar\n")
    with private_domain() as domain, pytest.MonkeyPatch.context() as environment:
        environment.setenv("ROS_DOMAIN_ID", str(domain))
        with starting(Forked, place) as start, connected() as user:
            states = user.listen(AxesState, f"{TWIN}/axes_state", 1000)
            blocks = user.listen(AxesWaveform, f"{TWIN}/axes_waveform", 1000)
            gearbox = user.listen(GearboxState, f"{TWIN}/gearbox_state", 1000)
            status = user.listen(RecorderStatus, f"{TWIN}/logger/status")
            logger = start("planetary_twin.logger", name="bag")
            given = {"scene": scene, "wait_for": f"{TWIN}/logger"} | SLOWLY
            twin = start("planetary_twin.simulation", **given)
            with Monitor(TWIN) as monitor:
                user.until(lambda: len(states) >= STATES and monitor.axes is not None, 120.0)
                user.until(
                    lambda: gearbox and gearbox[-1].simulated_time >= states[-1].simulated_time
                )
                shown = [
                    [str(cell) for cell in column.cells]
                    for column in monitor.table(120).columns[:2]
                ]
            # A signal may end the twin between two messages of an interval.
            end = float(user.pause(f"{TWIN}/simulation").split()[-2])  # "paused from 1.23 s"
            reached = pytest.approx(end, rel=1e-6)
            user.until(lambda: gearbox[-1].simulated_time == states[-1].simulated_time == reached)
            # Under overload, the last sample may be before the end.
            user.until(lambda: _end_of(blocks[-1]) > end - 1.01 * blocks[-1].sample_period)
            count = states[-1].sequence
            for name in ("axes_state", "axes_waveform", "gearbox_state"):
                user.until(lambda name=name: recorded(status, f"{TWIN}/{name}") == count)
            twin.send_signal(signal.SIGINT)
            twin.wait(LONG)
            logger.send_signal(signal.SIGINT)
            assert logger.wait(LONG) == 0
        table = "\n".join(f"{title}: {value}" for title, value in zip(*shown, strict=True))
        yield Run(states, gearbox, blocks, place / "recordings/bag", table)


def _end_of(block: AxesWaveform) -> float:
    return float(block.start_time + (block.samples - 1) * block.sample_period)


def test_states_of_axes_have_the_stamps_of_the_gearbox(run):
    first = run.states[0].sequence
    numbers = [state.sequence for state in run.states]
    assert numbers == list(range(first, first + len(run.states)))
    stamps = {state.simulated_time: state.header.stamp for state in run.gearbox}
    common = [state for state in run.states if state.simulated_time in stamps]
    assert len(common) >= STATES - 1
    assert all(state.header.stamp == stamps[state.simulated_time] for state in common)


def test_the_sun_floats_and_planets_share_the_load_as_in_statics(run):
    scene = pt.load_scene("floating_sun")
    expected = load_sharing(scene).share.mean(axis=0)
    settled = run.states[STATES // 2 :]
    share = np.mean([state.load_share[:4] for state in settled], axis=0)
    assert share == pytest.approx(expected, rel=5e-3)
    assert np.isnan(settled[0].load_share[4:]).all()
    # The sun has no bearing, so nothing presses on it, but its axis is displaced.
    assert {state.sun_bearing_force_peak for state in settled} == {0.0}
    away = np.hypot(settled[-1].sun_displacement_x, settled[-1].sun_displacement_y)
    moved = np.hypot(*load_sharing(scene).displacement.mean(axis=0)[0])
    assert away == pytest.approx(moved, rel=5e-2)


def test_the_recording_has_what_was_published_and_verifies(run):
    in_file = counts(run.folder)
    states, blocks = (in_file[f"{TWIN}/{name}"] for name in ("axes_state", "axes_waveform"))
    assert states == blocks == run.states[-1].sequence
    messages = read_all(run.folder)[f"{TWIN}/axes_state"].messages
    kept = [deserialize_message(message, AxesState) for message in messages]
    assert [state.sequence for state in kept] == list(range(1, states + 1))
    first = run.states[0]
    same = kept[first.sequence - 1]
    for name in first.get_fields_and_field_types():
        if name != "header":
            np.testing.assert_array_equal(getattr(same, name), getattr(first, name))
    assert same.header == first.header
    found = verify(run.folder, TWIN)
    assert found.identical
    assert found.messages["axes_state"] == states
    assert found.messages["axes_waveform"] == blocks


def test_the_monitor_shows_load_sharing_and_bearing_forces(run):
    rows = dict(line.split(": ") for line in run.table.splitlines())
    assert 1.1 < float(rows["Load sharing factor"]) < 1.2
    assert float(rows["Bearing force, peak, planet"]) > 1000.0
    assert float(rows["Displacement, peak, sun"]) > 1.0  # [um]


def test_a_node_reports_the_dynamics_that_auto_selects(peer, start, tmp_path):
    scene = tmp_path / "open.yaml"
    scene.write_text("base: floating_sun\nname: open\ndynamics: auto\n")
    reports = listen_to_reports(peer)
    states = peer.listen(AxesState, f"{TWIN}/axes_state", 1000)
    origins = peer.listen(String, f"{TWIN}/run_origin", LATCHED)
    start("planetary_twin.simulation", scene=scene)

    peer.until(lambda: states and statuses(reports, DYNAMICS) and origins)
    status = statuses(reports, DYNAMICS)[-1]
    assert status.level == DiagnosticStatus.OK
    assert status.message.startswith("dynamics = planar, selected by auto at 1000 rpm and 63 N m")
    values = {pair.key: pair.value for pair in status.values}
    assert values["dynamics"] == "planar"
    assert float(values["error.torsional"]) > float(values["allowed_error"]) > 0.0
    # What is recorded names the dynamics that ran, so that it can be simulated again.
    assert read_origin(origins[-1].data).scene.dynamics == "planar"
    assert peer.set(f"{TWIN}/simulation", input_torque=30.0).successful
    peer.until(lambda: statuses(reports, DYNAMICS)[-1].level == DiagnosticStatus.WARN)
    now = statuses(reports, DYNAMICS)[-1]
    assert now.message.startswith("input_torque changed since; dynamics =")


def test_held_axes_warn_while_load_shares_are_wrong(peer, start, tmp_path):
    scene = tmp_path / "held.yaml"
    point = "operating_point: {input_torque: 0 N m}"
    scene.write_text(f"base: floating_sun\nname: held\ndynamics: torsional\n{point}\n")
    reports = listen_to_reports(peer)
    start("planetary_twin.simulation", scene=scene)

    def accuracy() -> str:
        return peer.until(lambda: statuses(reports, ACCURACY))[-1].message

    peer.until(lambda: "holds all axes" not in accuracy())
    assert peer.set(f"{TWIN}/simulation", input_torque=63.0).successful
    peer.until(lambda: "planet 1 carries 3.67 times its share" in accuracy())
    assert peer.set(f"{TWIN}/simulation", input_torque=0.0).successful
    peer.until(lambda: "holds all axes" not in accuracy())


def test_quasi_static_axes_move_and_verify(peer, start, tmp_path):
    scene = tmp_path / "still.yaml"
    scene.write_text("base: floating_sun\nname: still\ndynamics: quasi_static_planar\n")
    logger = start("planetary_twin.logger", name="bag")
    states = peer.listen(AxesState, f"{TWIN}/axes_state", 1000)
    start("planetary_twin.simulation", scene=scene, wait_for=f"{TWIN}/logger", **SLOWLY)
    peer.until(lambda: len(states) >= 20, 120.0)
    expected = load_sharing(pt.load_scene(scene)).share.mean(axis=0)
    assert np.array(states[-1].load_share[:4]) == pytest.approx(expected, rel=5e-3)
    assert peer.set(f"{TWIN}/simulation", input_torque=30.0).successful
    changed = len(states)
    peer.until(lambda: len(states) >= changed + 5)
    logger.terminate()
    ended(logger)
    found = verify(tmp_path / "recordings/bag", TWIN)
    assert found.identical and found.messages["axes_state"] >= 20
