"""One command runs, records, shows and counts; it ends cleanly at any moment."""

import json
import os
import signal
import subprocess
import time
from pathlib import Path

import pytest
from mcap.reader import make_reader
from planetary_twin.running.node_settings import node_settings
from planetary_twin.simulation.publishing.publishers import STALL
from planetary_twin_msgs.msg import GearboxState
from std_srvs.srv import Trigger

from planetary_twin_py.scene import load_scene, parse_scene

from ..peer import LONG, TWIN
from ..processes import holding, working_in
from ..programs import ended, outcome, refuses
from ..recordings import counts, times_received, unfinished_states


def _line(process: subprocess.Popen[str], text: str) -> None:
    """Read the output up to a line that contains `text`."""
    assert process.stdout is not None
    for line in process.stdout:
        if text in line:
            return
    raise AssertionError(f"the run ended before it said {text!r}")


def test_a_run_records_every_message_it_publishes(run, tmp_path):
    process = run("--duration", "3", "--record", "bag", "--json", "-", "--set", "backlash=3e-7")
    output, _ = outcome(process, timeout=180)
    figures = json.loads(output)
    recorded = counts(tmp_path / "recordings/bag")
    assert {name: topic["recorded"] for name, topic in figures["topics"].items()} == recorded
    for topic in figures["topics"].values():
        assert topic["recorded"] + topic["lost"] == topic["published"]
    assert figures["topics"][f"{TWIN}/gearbox_state"]["lost"] == 0
    assert figures["topics"][f"{TWIN}/operating_point"]["published"] == 7
    assert figures["duration_s"] >= 3.0
    for topic, times in times_received(tmp_path / figures["file"]).items():
        assert times == sorted(times), topic
    with (tmp_path / figures["file"]).open("rb") as stream:
        attached = {a.name: a.data.decode() for a in make_reader(stream).iter_attachments()}
    assert parse_scene(attached["scene.yaml"]) == load_scene("paper")
    assert attached["robot_description.urdf"].strip().endswith("</robot>")
    assert Path(tmp_path / figures["file"]).exists()
    assert working_in(tmp_path) == []


@pytest.mark.exhaustive
def test_parameters_fixed_at_the_start_are_options_of_a_run(run):
    process = run("--duration", "0.5", "--no-tour", "--param", "publish_rate=200", "--json", "-")
    output, _ = outcome(process, timeout=180)
    states = json.loads(output)["topics"][f"{TWIN}/gearbox_state"]
    assert states["published"] >= 100  # 50 at the default rate
    refused = run("--param", "rate_factor=2")
    errors = ended(refused, 2)
    assert "--param 'rate_factor=2': must be NAME=VALUE, with NAME of" in " ".join(errors.split())


def test_a_clock_of_another_node_is_refused_with_advice():
    for text in ("use_sim_time=true", "use_sim_time=false", "use_sim_time"):
        with pytest.raises(ValueError, match="publishes no /clock") as refusal:
            node_settings([text])
        reason = str(refusal.value)
        assert reason.startswith(f"--param {text!r}: ") and "\n" not in reason
        assert "-p use_sim_time:=true" in reason and "twin.launch.py" in reason


def _reported(folder: Path) -> dict[str, int]:
    """What a run says of the messages of the state."""
    figures = json.loads((folder / "figures.json").read_text())
    return figures["topics"][f"{TWIN}/gearbox_state"]


@pytest.mark.exhaustive
def test_losses_of_a_stopped_logger_are_reported(run, peer, tmp_path):
    process = run("--duration", "600", "--no-tour", "--record", "bag", "--json", "figures.json")
    _line(process, "rpm")
    for service in ("stop", "start"):
        assert peer.call(Trigger, f"{TWIN}/logger/{service}", Trigger.Request(), 20.0).success
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    peer.until(lambda: len(states) > 100)
    process.send_signal(signal.SIGINT)
    output, _ = outcome(process)
    states = _reported(tmp_path)
    held = [counts(bag)[f"{TWIN}/gearbox_state"] for bag in tmp_path.glob("recordings/*")]
    assert len(held) == 2 and sum(held) == states["recorded"]
    assert states["recorded"] + states["lost"] == states["published"]
    assert "while the logger was stopped" in output


def _process_of(node: str, folder: Path) -> int:
    """The process of a node that a run in `folder` has started."""
    commands = {n: Path(f"/proc/{n}/cmdline").read_bytes() for n in working_in(folder)}
    (number,) = [n for n, each in commands.items() if f"planetary_twin.{node}".encode() in each]
    return number


@pytest.mark.exhaustive
def test_a_run_whose_logger_stalls_long_reports_the_losses(run, peer, tmp_path):
    process = run("--duration", "600", "--no-tour", "--record", "bag", "--json", "figures.json")
    _line(process, "rpm")
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    peer.until(lambda: states)
    logger = _process_of("logger", tmp_path)
    os.kill(logger, signal.SIGSTOP)
    until = states[-1].simulated_time + STALL + 1.0
    peer.until(lambda: states[-1].simulated_time > until)
    os.kill(logger, signal.SIGCONT)
    again = states[-1].simulated_time + 1.0
    peer.until(lambda: states[-1].simulated_time > again)
    process.send_signal(signal.SIGINT)
    errors = ended(process, 1)
    reported = _reported(tmp_path)
    recorded = counts(tmp_path / "recordings/bag")[f"{TWIN}/gearbox_state"]
    assert (
        reported["lost"] > 0
        and reported["recorded"] == recorded == reported["published"] - reported["lost"]
    )
    (line,) = [line for line in errors.splitlines() if line.startswith("planetary-twin: ")]
    assert f"{reported['lost']} of {TWIN}/gearbox_state" in line


def test_ctrl_c_leaves_a_readable_recording_and_the_table(run, tmp_path):
    process = run("--duration", "600", "--record", "bag")
    _line(process, "rpm")
    process.send_signal(signal.SIGINT)
    output, _ = outcome(process)
    assert "published" in output
    assert counts(tmp_path / "recordings/bag")[f"{TWIN}/gearbox_state"] > 0
    assert working_in(tmp_path) == []


def test_ctrl_c_during_the_start_leaves_nothing_running(run, tmp_path):
    process = run("--duration", "600")
    deadline = time.monotonic() + LONG
    while not holding(process.pid, "_rclpy"):  # earlier, Python has not read the command yet
        assert time.monotonic() < deadline and process.poll() is None
    process.send_signal(signal.SIGINT)
    ended(process)
    assert working_in(tmp_path) == []
    # Either there is a recording of a twin that ran, or no recording.
    assert all(counts(bag)[f"{TWIN}/gearbox_state"] for bag in tmp_path.glob("recordings/*"))


def test_the_death_of_a_node_ends_the_run_with_one_line(run, tmp_path):
    process = run("--duration", "600")
    _line(process, "rpm")
    os.kill(_process_of("logger", tmp_path), signal.SIGKILL)
    refuses(process, "logger: ended by SIGKILL; the recording is in recordings/")
    assert working_in(tmp_path) == []


def test_sigkill_of_the_run_ends_its_nodes(run, tmp_path):
    process = run("--duration", "600", "--record", "bag")
    _line(process, "rpm")
    bag = tmp_path / "recordings/bag"
    deadline = time.monotonic() + LONG
    while not unfinished_states(bag / "bag_0.mcap"):  # until the first flush
        assert time.monotonic() < deadline
        time.sleep(0.1)
    process.kill()
    process.communicate(timeout=LONG)
    deadline = time.monotonic() + LONG
    while working_in(tmp_path):
        assert time.monotonic() < deadline
        time.sleep(0.05)
    assert counts(bag)[f"{TWIN}/gearbox_state"] > 0


@pytest.mark.parametrize(
    ("options", "reason"),
    [(["--set", "backlash=7"], "backlash"), (["--record", "../x"], "--record")],
)
def test_an_invalid_option_ends_before_any_process_starts(run, tmp_path, options, reason):
    process = run(*options)
    refuses(process, reason, code=2)
    assert not (tmp_path / "recordings").exists()


def test_a_run_does_not_start_beside_another_publisher_of_a_twin(run, peer, tmp_path):
    peer.node.create_publisher(GearboxState, f"{TWIN}/gearbox_state", 10)
    process = run("--duration", "60", "--record", "bag")
    errors = ended(process, 1)
    assert "/peer runs on ROS_DOMAIN_ID" in errors
    assert not (tmp_path / "recordings/bag").exists()
