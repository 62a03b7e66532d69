"""A what-if run equals the recording up to the branch, then a twin with the new settings."""

import math

import numpy as np
import pytest
from command_line import invoke, succeed
from twin_recording import NAMESPACE, decoded, messages, record

import planetary_twin_py as pt
from planetary_twin_py.recording.ros2.playback import Playback
from planetary_twin_py.recording.runs.branch import Branch
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.recording.runs.verify import verify
from planetary_twin_py.recording.runs.what_if import resimulate
from planetary_twin_py.view.show import scene_of

FOUR = tuple(0.5 * math.pi * n for n in range(4))


@pytest.fixture(scope="module")
def branched(sound, tmp_path_factory):
    """The first run, with another lambda ratio from 50 ms on, before the recorded one at 100 ms."""
    branch = Branch({"lambda_ratio": "1.2"}, 0.045, run=1)
    return resimulate(sound, NAMESPACE, branch, tmp_path_factory.mktemp("branch") / "bag")


def test_up_to_the_branch_it_is_identical_bit_for_bit(sound, branched):
    assert branched.begins == 0.05
    before, after = messages(sound), messages(branched.file)
    same = next(n for n, (old, new) in enumerate(zip(before, after, strict=False)) if old != new)
    assert before[:same] == after[:same]
    assert same == 3 + 3 * 5  # origin, description and point; then five intervals on three topics
    assert after[same][0] == f"{NAMESPACE}/operating_point"


def test_from_the_branch_on_it_equals_a_twin_with_these_settings(branched):
    recording = read_recording(branched.file)
    twin = pt.Twin(pt.load_scene("paper"), 10_000.0, 1e-3)
    for number in range(31):
        if number == 5:
            twin.set(lambda_ratio=1.2)
        elif number == 10:
            twin.set(backlash=3e-7)
        elif number == 15:
            twin.set_tolerance(1e-2)
        elif number == 20:
            twin.set_sample_rate(5_000.0)
        window = twin.advance(0.01 if number < 30 else 0.0001)
        assert recording.state["power_loss"][number] == window.power_loss
        assert np.array_equal(recording.per_mesh("dte_rms")[number], window.mesh["dte_rms"], True)


def test_the_branch_is_a_recording_like_any_other(sound, branched):
    verdict = verify(branched.file.parent, NAMESPACE)
    assert verdict.identical and verdict.same_makers
    assert verdict.messages == {"gearbox_state": 31, "joint_states": 31, "mesh_waveform": 30}
    assert Playback(branched.file).topics == Playback(sound).topics
    states = decoded(branched.file.parent, f"{NAMESPACE}/gearbox_state")
    recording = read_recording(branched.file)
    assert [m.power_loss for m in states] == list(recording.state["power_loss"])
    scene, remark = scene_of(recording)
    assert remark is None and scene == pt.load_scene("paper")


def test_a_branch_at_the_start_may_change_the_model(sound, tmp_path):
    branch = Branch({"gearset.planet_angles": FOUR, "input_torque": "30 N m"}, duration=0.05)
    made = resimulate(sound, NAMESPACE, branch, tmp_path / "bag")
    assert made.remarks == ["has 2 runs, the last is simulated; use --run to select"]
    recording = read_recording(made.file)
    assert recording.planets == 4 and len(recording.state) == 5
    assert np.array_equal(recording.operating_point["input_torque"], [30.0])
    assert np.array_equal(recording.operating_point["input_speed"], [150.0])
    scene, _ = scene_of(recording)
    window = pt.Twin(scene, 10_000.0, 1e-3).advance(0.01)
    assert recording.state["power_loss"][0] == window.power_loss
    assert verify(made.file, NAMESPACE).identical


def test_a_run_can_be_continued_beyond_its_end(sound, tmp_path):
    branch = Branch({"lambda_ratio": 2.0}, 0.1, duration=0.125)
    made = resimulate(sound, NAMESPACE, branch, tmp_path / "bag")
    state = read_recording(made.file).state
    assert made.end == 0.125
    assert np.array_equal(np.rint(state.time * 1e3), [*range(10, 130, 10), 125])
    assert np.array_equal(np.diff(state.stamp), [10_000_000] * 11 + [5_000_000])
    assert verify(made.file, NAMESPACE).identical


def test_messages_lost_in_recording_are_computed_again(sound, tmp_path):
    def losing(topic, number, row):
        return None if topic in ("gearbox_state", "joint_states") and number in (5, 6) else row

    holes = record(tmp_path / "holes", losing)
    made = resimulate(holes, NAMESPACE, Branch({}, run=1), tmp_path / "filled")
    whole = resimulate(sound, NAMESPACE, Branch({}, run=1), tmp_path / "whole")
    assert messages(made.file) == messages(whole.file)


@pytest.mark.parametrize(
    "arguments, words",
    [
        (("--set", "lambda_ratio=11"), ["lambda_ratio = 11.0:", "within 0 and 10"]),
        (("--set", "lambda_ratio"), ["NAME=VALUE"]),
        (("--set", "mesh.ramp=0", "--from", "0.05"), ["mesh.ramp", "requires --from = 0"]),
        (("--from", "0.2"), ["--from = 0.2 s", "within 0 and 0.09 s"]),
        (("--duration", "0"), ["--duration = 0.0 s", "above 0 and at most 3600"]),
        (("--namespace", "other"), ["namespace = /other", NAMESPACE]),
        (("--out", "."), ["--out = '.'", "exists"]),
    ],
)
def test_invalid_arguments_end_in_one_line_and_leave_no_file(sound, tmp_path, arguments, words):
    folder = tmp_path / "bag"
    given = ["resimulate", str(sound), "--out", str(folder), *arguments]
    answer = invoke(*given)
    assert answer.exit_code == 2, answer.output
    lines = [line for line in answer.stderr.splitlines() if line]
    assert len(lines) == 1 and all(word in lines[0] for word in words), answer.stderr
    assert not folder.exists()


def test_the_command_prints_the_instant_of_the_branch(sound, tmp_path):
    given = ["--run", "1", "--set", "backlash=0.4 um", "--from", "0.3", "--out", tmp_path / "bag"]
    answer = succeed("resimulate", *[sound.parent, *given])
    assert "as recorded until 0.3 s, then as set until 0.3001 s" in answer.stdout
    assert read_recording(tmp_path / "bag").operating_point["backlash"][-1] == 4e-7
