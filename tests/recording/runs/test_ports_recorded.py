"""Changes of ports are recorded; those of versions that did not record them are recognised."""

import re
from dataclasses import replace

import pytest
from rosbags.typesys import get_types_from_msg
from twin_recording import NAMESPACE

import planetary_twin_py as pt
from planetary_twin_py.model.clock import TICKS
from planetary_twin_py.recording.ros2.bag import BagWriter
from planetary_twin_py.recording.ros2.definitions import topics_of
from planetary_twin_py.recording.ros2.topics import POINT
from planetary_twin_py.recording.runs.branch import Branch
from planetary_twin_py.recording.runs.compose import Composer
from planetary_twin_py.recording.runs.info import read_info
from planetary_twin_py.recording.runs.intervals import Interval, Intervals
from planetary_twin_py.recording.runs.origin import Origin, makers_here
from planetary_twin_py.recording.runs.schedule import (
    Change,
    RecordedRun,
    nanoseconds,
    read_runs,
)
from planetary_twin_py.recording.runs.verify import verify
from planetary_twin_py.recording.runs.what_if import resimulate, write_run

DRIVEN = {"drive.input.port": "torque", "drive.output.port": "torque"}
BRAKE = range(6, 12)  # intervals with the brake


def braked_run(port="motion"):
    """A run whose torques are given, with a brake of the input in between, as of both versions."""
    scene, length = pt.load_scene("paper").replace(**DRIVEN), TICKS // 100
    intervals = Intervals(
        Interval(n + 1, nanoseconds((n + 1) * length), n * length, (n + 1) * length, 1e-3, 1e4)
        for n in range(16)
    )
    change = Change(1, 0, 0.0, scene.live_values)
    run = RecordedRun(Origin(scene, 0, makers_here()), intervals, [change])
    given, changes = {}, list(run.changes)
    for n, interval in enumerate(run.intervals):
        values = {"input_torque": 63.0 + n, "output_torque": 147.0 - n}
        if n in BRAKE:
            values = {"input_speed": 104.7 - 5.0 * (n - BRAKE[0]), "output_torque": 0.0}
        if port == "motion" or n not in BRAKE:
            given[interval.stamp] = values
    for number, ports in ((BRAKE[0], DRIVEN | {"drive.input.port": port}), (BRAKE[-1] + 1, DRIVEN)):
        begin, stamp = run.intervals[number].begin, run.intervals[number - 1].stamp
        values = run.changes[0].values | ports
        changes.append(Change(0, stamp, begin * 1e-12, values))
    return replace(run, changes=changes, given=given)


def written(run, folder, define=lambda text: text):
    """The run as written by a version whose definition of OperatingPoint is altered."""
    bag = BagWriter(folder)
    topics = [
        replace(topic, definition=define(topic.definition)) if topic.name.endswith(POINT) else topic
        for topic in topics_of(NAMESPACE, driven=True)
    ]
    for _ in write_run(Composer(bag, topics, NAMESPACE), run):
        pass
    bag.close()
    return bag.file


def without_ports(text):
    old = re.sub(r"^string +(input|output)_port .*\n", "", text, flags=re.MULTILINE)
    kind = "planetary_twin_msgs/msg/OperatingPoint"
    fields = [name for name, _ in get_types_from_msg(old, kind)[kind][1]]
    assert fields[-1] == "torque_ripple"
    return old


@pytest.fixture(scope="module")
def run():
    return braked_run()


def ports_of(file):
    (run,) = read_runs(file, NAMESPACE, [])
    return [
        (
            round(change.time, 9),
            change.values["drive.input.port"],
            change.values["drive.output.port"],
        )
        for change in run.changes
        if "drive.input.port" in change.values
    ]


CHANGED = [(0.06, "motion", "torque"), (0.12, "torque", "torque")]


def test_changes_of_ports_are_recorded_listed_and_verified(run, tmp_path):
    file = written(run, tmp_path / "bag")
    assert ports_of(file) == [(0.0, "torque", "torque"), *CHANGED]
    assert verify(file, NAMESPACE).identical
    listed = [change.values for change in read_info(file).changes[1:]]
    assert listed == [{"drive.input.port": "motion"}, {"drive.input.port": "torque"}]


def test_ports_that_were_not_recorded_follow_from_the_commands(run, tmp_path):
    """An earlier version recorded a brake only by what was given."""
    file = written(run, tmp_path / "bag", without_ports)
    assert ports_of(file) == CHANGED
    assert verify(file, NAMESPACE).identical
    made = resimulate(file, NAMESPACE, Branch({"backlash": 4e-7}, 0.08), tmp_path / "branch")
    assert ports_of(made.file)[-1] == CHANGED[-1]
    assert verify(made.file, NAMESPACE).identical


def test_commands_that_are_not_recorded_are_named(tmp_path):
    without_commands = topics_of(NAMESPACE)
    bag = BagWriter(tmp_path / "bag")
    for _ in write_run(Composer(bag, without_commands, NAMESPACE), braked_run()):
        pass
    bag.close()
    result = verify(bag.file, NAMESPACE)
    assert result.first_difference is not None
    assert any("applied_commands has no message of it" in remark for remark in result.remarks)


def test_a_brake_is_recorded_as_a_port_and_verified(tmp_path):
    file = written(braked_run("brake"), tmp_path / "bag")
    assert ports_of(file)[1:] == [(0.06, "brake", "torque"), CHANGED[1]]
    assert verify(file, NAMESPACE).identical
    made = resimulate(file, NAMESPACE, Branch({"backlash": 4e-7}, 0.08), tmp_path / "branch")
    assert verify(made.file, NAMESPACE).identical
