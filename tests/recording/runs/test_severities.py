"""Severities over the time of a recording, against those of the twin that was recorded."""

import numpy as np
import pytest
from twin_recording import START_NS, TwinRecording

import planetary_twin_py as pt
from planetary_twin_py.model.gearbox import Gearbox
from planetary_twin_py.recording.runs.reader import Series, read_recording
from planetary_twin_py.recording.runs.severities import Recorded, grown_before, stretches
from planetary_twin_py.view.contacts import forces
from planetary_twin_py.view.motion import motion

CRACKED = pt.load_scene("cracked_tooth")
SET = {"kind": "crack", "gear": "sun", "tooth": 2, "stiffness_loss": 0.0}
TABLE = SET | {"growth": {"time": [0.05, 0.25], "stiffness_loss": [0.0, 0.4]}}
PARIS = {
    "law": "paris", "constant": 1e-11, "exponent": 3.0, "stress_range": 2e8, "until": 6e-4,
    "acceleration": 1e3, "force": 1500.0,
}  # fmt: skip
BY_LOAD = {"kind": "crack", "gear": "sun", "tooth": 2, "depth": 1e-4, "growth": PARIS}


def recorded(folder, fault, changes=None):
    """Scene, recording, and severities of the twin by time, of 0.3 s in intervals of 10 ms."""
    scene = CRACKED.replace(faults=[fault])
    recording, twin = TwinRecording(folder), pt.Twin(scene, 50_000.0, 1e-4)
    recording.begin(twin, START_NS)
    found = []
    for number in range(30):
        if number in (changes or {}):
            twin.set(**changes[number])
            recording.point(twin)
        recording.advance(twin, 0.01)
        found.append(twin.severities["faults.0." + fault_field(fault)])
    recording.finish()
    return scene, read_recording(recording.file), np.array(found)


def fault_field(fault):
    return "depth" if "depth" in fault else "stiffness_loss"


def drawn(scene, recording):
    """Rows of the motion and the severity in each."""
    moved = motion(recording)
    rows = Recorded(moved.time, moved.stamp, moved.angle, forces(recording, moved.time))
    found = stretches(Gearbox(scene), recording.operating_point, rows)
    assert [s.begin for s in found[1:]] == [s.end for s in found[:-1]]
    assert found[0].begin == 0 and found[-1].end == len(moved.time)
    (name,) = scene.severities
    return moved.time, np.concatenate([[s.severities[name]] * (s.end - s.begin) for s in found])


def test_a_severity_that_is_set_is_drawn_from_then_on(tmp_path):
    changes = {10: {"faults.0.stiffness_loss": 0.3}, 20: {"faults.0.stiffness_loss": 0.1}}
    time, severity = drawn(*recorded(tmp_path / "a", SET, changes)[:2])
    expected = np.select([time > 0.2 + 1e-9, time > 0.1 + 1e-9], [0.1, 0.3], 0.0)
    assert np.array_equal(severity, expected)


def test_a_severity_of_a_table_is_drawn_as_it_grows(tmp_path):
    time, severity = drawn(*recorded(tmp_path / "a", TABLE)[:2])
    expected = np.interp(time, [0.05, 0.25], [0.0, 0.4])
    assert np.abs(severity - expected).max() < 0.02 * 0.4 + 0.4 * 0.01 / 0.2  # steps of 10 ms
    assert severity[0] == 0.0 and severity[-1] == pytest.approx(0.4)


def test_growth_by_load_is_drawn_as_in_the_run_after_a_change(tmp_path):
    """The crack is set to another depth in between; the rest of its growth is that of the run."""
    changes = {15: {"faults.0.depth": 1.2e-4}}
    scene, recording, run = recorded(tmp_path / "a", BY_LOAD, changes)
    time, severity = drawn(scene, recording)
    ends = np.searchsorted(time, 0.01 * np.arange(1, 31) - 1e-9)  # rows at these times
    assert run[-1] > 1.05 * 1.2e-4 > 1.05 * run[0]
    # What a run has grown at the end of an interval is of the next one.
    wrong = np.abs(severity[ends[1:] - 1] - run[1:])
    assert wrong.max() < 0.02 * run[-1]


def test_growth_before_a_recording_begins_is_remarked_of_laws_alone():
    """A table says how far it has grown; a law does not, unless it was set since."""

    def said(fault, *times):
        points = Series(np.array(times), np.zeros(len(times), np.int64), {})
        return grown_before(CRACKED.replace(faults=[fault]), points, np.array([20.0]))

    assert "faults.0: how far it has grown from 3 s, " in said(BY_LOAD, 0.0, 3.0, 25.0)
    assert said(BY_LOAD, 0.0, 19.9) is None
    assert said(TABLE, 0.0) is None and said(SET, 0.0) is None
