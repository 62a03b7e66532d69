"""A run without ROS is recorded as the nodes would have published it."""

import json
import sys
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from command_line import invoke, succeed
from rosbags.highlevel import AnyReader

import planetary_twin_py as pt
from planetary_twin_py.recording.ros2.definitions import KINDS, topics_of
from planetary_twin_py.recording.runs.offline import NAMESPACE, Plan, record_run
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.recording.runs.verify import verify
from planetary_twin_py.run import windows
from planetary_twin_py.run.start import start

MSGS_SPEC = Path(__file__).parents[3] / "msgs_spec"

simulate = partial(invoke, "simulate")
simulated = partial(succeed, "simulate")


@pytest.mark.parametrize("name", ["run.mcap", "run"])
def test_a_run_is_written_as_file_or_folder(tmp_path, name):
    simulated("paper", "--duration", "0.045", "--out", tmp_path / name)
    assert [path.name for path in tmp_path.iterdir()] == [name]
    recording = read_recording(tmp_path / name)
    assert np.array_equal(recording.state.time, [0.01, 0.02, 0.03, 0.04, 0.045])
    changed = ",".join([*pt.TUNABLES, "input_port", "output_port"])
    assert np.array_equal(recording.operating_point["changed"], [changed])
    wave = pt.simulate(pt.load_scene("paper"), 0.045)
    assert np.array_equal(recording.waveform.dte, wave.dte.astype(np.float32))
    verdict = verify(tmp_path / name, NAMESPACE)
    assert verdict.identical and verdict.messages["mesh_waveform"] == 5
    with AnyReader([tmp_path / name]) as bag:
        assert bag.message_count == 3 * 5 + 3
    assert "unknown: the file has no count of lost" in invoke("info", tmp_path / name).stdout
    assert simulate("paper", "--duration", "0.045", "--out", tmp_path / name).exit_code == 2


def test_a_recorded_run_is_simulated_once(tmp_path, monkeypatch):
    """Up to quadrature within the steps in which recorded intervals end."""
    asked, seen, started = (
        ["paper", "--duration", "0.023", "--settling", "0.0134", "--json"],
        [],
        [],
    )
    monkeypatch.setattr(windows, "start", lambda *how: started.append(how) or start(*how))
    for out in ([], ["--out", tmp_path / "run.mcap"]):
        simulated(*asked, tmp_path / "report.json", *out)
        seen.append(json.loads((tmp_path / "report.json").read_text()))
        assert len(started) == len(seen)
        del seen[-1]["real_time_factor"], seen[-1]["energy_residual"]
    assert flat(seen[1]) == pytest.approx(flat(seen[0]), rel=1e-6, nan_ok=True)
    assert verify(tmp_path / "run.mcap", NAMESPACE).identical
    state = read_recording(tmp_path / "run.mcap").state
    assert state.time == pytest.approx([0.01, 0.0134, 0.0234, 0.0334, 0.0364], abs=1e-12)


def test_memory_does_not_grow_with_the_recorded_time(tmp_path):
    plan = Plan(pt.load_scene("paper"), duration=0.2, sample_rate=50_000.0, tolerance=1e-4)
    _, result = record_run(plan, tmp_path / "run.mcap", lambda time: None)
    assert result.time[-1] == 0.2 and len(result.time) == 500  # of 10 ms


def flat(report):
    """Numbers of a report by their keys."""
    parts = {key: value for key, value in report.items() if isinstance(value, dict)}
    numbers = {key: value for key, value in report.items() if isinstance(value, float)}
    return numbers | {f"{key}.{name}": n for key in parts for name, n in flat(parts[key]).items()}


def test_the_topics_are_those_of_the_built_interfaces():
    for topic in topics_of(NAMESPACE):
        package, _, name = topic.type.split("/")
        installed = Path(sys.prefix, "share", package, "msg", f"{name}.json").read_text()
        (digest,) = {
            entry["hash_string"]
            for entry in json.loads(installed)["type_hashes"]
            if entry["type_name"] == topic.type
        }
        assert topic.type_hash == digest


def test_the_definitions_are_those_of_the_interface_package():
    own = Path(pt.__file__).parent / "recording" / "ros2" / "msg"
    assert own.resolve() == MSGS_SPEC / "msg"
    for kind in KINDS.values():
        if kind.startswith("planetary_twin_msgs"):
            (topic,) = [topic for topic in topics_of("", True, ages=True) if topic.type == kind]
            text = (MSGS_SPEC / "msg" / f"{kind.rpartition('/')[2]}.msg").read_text()
            assert topic.definition.startswith(text)
