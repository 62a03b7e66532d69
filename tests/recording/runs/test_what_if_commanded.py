"""A what-if run whose commands at one shaft, or both, are others than the recorded ones."""

import numpy as np
import pytest
from command_line import invoke, succeed
from twin_recording import NAMESPACE

import planetary_twin_py as pt
from planetary_twin_py.recording.ros2.playback import Playback
from planetary_twin_py.recording.runs import recorded_commands as recorded_commands_of
from planetary_twin_py.recording.runs.branch import Branch
from planetary_twin_py.recording.runs.intervals import Intervals
from planetary_twin_py.recording.runs.offline import Plan, record
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.recording.runs.schedule import read_runs
from planetary_twin_py.recording.runs.verify import verify
from planetary_twin_py.recording.runs.what_if import resimulate
from planetary_twin_py.recording.tables.command_table import read_commands

COUNT, LENGTH = 20, 0.01  # intervals, and their length [s]


def recorded_load(n):
    """Torque of the load in interval n [N m]."""
    return 147.0 + 5.0 * np.sin(n)


@pytest.fixture(scope="module")
def machine(tmp_path_factory):
    """A run of motor and load, without commands."""
    plan = Plan(pt.load_scene("paper"), COUNT * LENGTH, 10_000.0, 1e-3)
    return record(plan, tmp_path_factory.mktemp("machine") / "bag").parent


@pytest.fixture(scope="module")
def driven(machine, tmp_path_factory):
    """The same with given torques of motor and load, which change at each interval."""
    number = np.arange(COUNT)
    course = pt.Commands(
        number * LENGTH,
        input_torque=63.0 + 2.0 * np.cos(number),
        output_torque=recorded_load(number),
    )
    folder = tmp_path_factory.mktemp("driven") / "bag"
    return resimulate(machine, NAMESPACE, Branch({}, commands=course), folder).file.parent


def commands_of(folder):
    (run,) = read_runs(folder, NAMESPACE, [])
    return [run.given.get(interval.stamp, {}) for interval in run.intervals]


def test_commands_are_recorded_and_verified(machine, driven):
    given = commands_of(driven)
    assert [each["output_torque"] for each in given] == [recorded_load(n) for n in range(COUNT)]
    assert f"{NAMESPACE}/applied_commands" not in Playback(machine).topics
    assert verify(driven, NAMESPACE).identical


def test_one_shaft_has_other_commands(driven, tmp_path):
    branch = Branch({}, 0.05, commands=pt.Commands(np.array([0.0, 0.123]), output_torque=[140, 99]))
    made = resimulate(driven, NAMESPACE, branch, tmp_path / "bag")
    recording = read_recording(made.file)
    twin = pt.Twin(
        pt.load_scene("paper").replace(
            **{"drive.input.port": "torque", "drive.output.port": "torque"}
        ),
        10_000.0,
        1e-3,
    )
    for n in range(COUNT):
        # The first interval at or after 0.123 s begins at 0.13 s.
        load = recorded_load(n) if n < 5 else 140.0 if n < 13 else 99.0
        window = twin.advance(LENGTH, input_torque=63.0 + 2.0 * np.cos(n), output_torque=load)
        assert recording.state["power_loss"][n] == window.power_loss
    assert verify(made.file.parent, NAMESPACE).identical
    given = commands_of(made.file.parent)
    assert given[5] == {"input_torque": 63.0 + 2.0 * np.cos(5), "output_torque": 140.0}
    assert given[6] == {"input_torque": 63.0 + 2.0 * np.cos(6)}


def test_a_shaft_may_follow_positions_instead_of_torque(driven, tmp_path):
    scene = pt.load_scene("paper")
    ports = {"drive.input.port": "torque", "drive.output.port": "motion"}
    begin = pt.Twin(scene.replace(**ports)).port_states.output_angle
    time = np.arange(1, COUNT) * LENGTH
    course = pt.Commands(time, output_position=begin - 44.88 * (time + LENGTH))
    made = resimulate(driven, NAMESPACE, Branch({}, commands=course), tmp_path / "bag")
    state = read_recording(made.file).state
    assert state["ring_speed"][2:] == pytest.approx(-44.88, rel=0.02)
    assert made.scene.drive.ports == ("torque", "motion")
    assert verify(made.file.parent, NAMESPACE).identical


def test_commands_of_a_changed_port_have_no_effect(driven, tmp_path):
    course = pt.Commands(np.array([0.1, 0.15]), output_speed=[-44.88, -44.0])
    branch = Branch({"drive.input.port": "machine", "input_speed": 100.0}, 0.1, commands=course)
    made = resimulate(driven, NAMESPACE, branch, tmp_path / "bag")
    recording, before = read_recording(made.file), read_recording(driven)
    assert recording.state["ring_speed"][-4:] == pytest.approx(-44.0, rel=0.02)
    assert np.array_equal(recording.state["power_loss"][:10], before.state["power_loss"][:10])
    assert list(recording.operating_point["output_port"]) == ["torque", "motion"]
    assert list(recording.operating_point["input_port"]) == ["torque", "machine"]
    assert all("input_torque" not in each for each in commands_of(made.file.parent)[10:])
    assert verify(made.file.parent, NAMESPACE).identical


@pytest.mark.parametrize(
    ("branch", "message"),
    [
        (
            Branch({"drive.output.port": "pedal"}, 0.05),
            "drive.output.port = 'pedal': must be 'machine', 'torque', 'motion' or 'brake'",
        ),
        (
            Branch({"drive.output.inertia": 1.0}, 0.05),
            "drive.output.inertia: changes the model, which requires from = 0",
        ),
        (
            Branch({}, commands=pt.Commands(np.zeros(1), np.zeros(1), None, np.zeros(1))),
            "input_speed: torque and motion cannot both be given at input",
        ),
        (
            Branch({}, commands=pt.Commands(np.zeros(1), input_torque=np.array([1e9]))),
            "input_torque = 1000000000.0 N m: must be within",
        ),
    ],
)
def test_commands_that_a_run_cannot_have_are_refused(driven, tmp_path, branch, message):
    with pytest.raises(ValueError, match=message):
        resimulate(driven, NAMESPACE, branch, tmp_path / "bag")


def table(folder, text):
    path = folder / "load.csv"
    path.write_text(text)
    return path


def test_a_table_has_units_and_empty_cells(tmp_path):
    text = "time [ms],output_speed [rpm],input_torque\n0,60,1\n10,,2\n"
    found = read_commands(table(tmp_path, text))
    assert found.time == pytest.approx([0.0, 0.01])
    assert found.output_speed == pytest.approx([2.0 * np.pi, np.nan], nan_ok=True)
    assert list(found.input_torque) == [1.0, 2.0]
    assert found.names == ["input_torque", "output_speed"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("time,output_torqe\n0,1\n", "column 'output_torqe': no such quantity.*output_torque"),
        ("output_torque\n1\n", "column 'time': missing"),
        ("time\n1\n", "has no column of commands; possible: input_torque"),
        ("time,output_torque\n1,1\n0,2\n", "commands.time: must be finite numbers in increasing"),
        ("time,output_torque [rpm]\n1,1\n", "column 'output_torque'"),
        (
            "time,output_position\n0,1\n",
            "output_position = 1.0 rad at time 0: must be NaN",
        ),
    ],
)
def test_a_table_that_makes_no_sense_is_refused_in_one_line(tmp_path, text, message):
    with pytest.raises(ValueError, match=message) as refusal:
        read_commands(table(tmp_path, text))
    assert "\n" not in str(refusal.value)


def test_commands_of_another_recording_act_at_the_same_times(machine, driven, tmp_path):
    out = tmp_path / "bag"
    arguments = ["resimulate", str(machine), "--commands", str(driven), "--out", str(out)]
    succeed(*arguments)
    assert commands_of(out) == commands_of(driven)
    refused = invoke(*arguments[:3], machine, "--out", f"{out}2")
    assert refused.exit_code == 2
    assert "the last run has no commands at its ports" in refused.output


def test_commands_of_missing_intervals_are_reported(driven, monkeypatch):
    (run,) = read_runs(driven, NAMESPACE, [])
    run.intervals = Intervals([*run.intervals[:3], *run.intervals[5:]])
    monkeypatch.setattr(recorded_commands_of, "read_runs", lambda *_: [run])
    remarks = []
    assert len(recorded_commands_of.recorded_commands(driven, remarks)) == COUNT - 2
    assert [remark.endswith("2 intervals are missing, and commands that acted in them")
            for remark in remarks] == [True]  # fmt: skip
