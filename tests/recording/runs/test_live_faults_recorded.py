"""Severities that change and grow are recorded, verified, and changed after the fact."""

import numpy as np
import pytest
from twin_recording import NAMESPACE, START_NS, TwinRecording

import planetary_twin_py as pt
from planetary_twin_py.recording.runs.branch import Branch
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.recording.runs.schedule import read_runs
from planetary_twin_py.recording.runs.verify import verify
from planetary_twin_py.recording.runs.what_if import resimulate

GROWTH = {"law": "archard", "coefficient": 1e-18, "pressure": 1.2e9, "half_width": 2e-4,
          "slip": 0.5, "until": 5e-6, "acceleration": 3e6}  # fmt: skip
FAULTS = [
    {"kind": "crack", "gear": "sun", "stiffness_loss": 0.0},
    {"kind": "wear", "gear": "planet", "tooth": "all", "planet": "all", "depth": 0.0,
     "growth": GROWTH},
]  # fmt: skip
SCENE = pt.load_scene("paper").replace(faults=FAULTS)
CHANGES = {
    5: {"faults.0.stiffness_loss": 0.1},
    8: {"backlash": 3e-7},  # the wear goes on growing
    12: {"faults.0.stiffness_loss": 0.2, "faults.1.depth": 0.0},  # flanks are replaced
}


@pytest.fixture(scope="module")
def worsened(tmp_path_factory):
    recording = TwinRecording(tmp_path_factory.mktemp("faults") / "bag")
    twin = pt.Twin(SCENE, 10_000.0, 1e-3)
    recording.begin(twin, START_NS)
    for number in range(16):
        if number in CHANGES:
            twin.set(**CHANGES[number])
            recording.point(twin)
        recording.advance(twin, 0.01)
    recording.finish()
    return recording.file


def test_a_run_with_changing_faults_is_verified_bit_for_bit(worsened):
    result = verify(worsened, NAMESPACE)
    assert result.identical and result.values > 1000


PITTED = pt.load_scene("floating_sun").replace(
    **{
        "dynamics": "planar", "supports.planet.bearing": None, "supports.planet.damping": None,
        "supports.planet.rolling": {"rollers": 14, "length": 0.012},
        "faults": [
            {"kind": "bearing", "planet": 2, "element": "inner", "ratio": 0.2, "depth": 1e-6},
            {"kind": "bearing", "element": "outer", "ratio": 0.2, "depth": 0.0,
             "growth": {"time": [0.0, 0.1], "depth": [0.0, 5e-6]}},
        ],
    }
)  # fmt: skip
BY_LOAD = SCENE.replace(**{"faults.1.growth.force": 1000.0})


@pytest.mark.parametrize(
    ("scene", "changes"),
    [(PITTED, {"faults.0.depth": 3e-6}), (BY_LOAD, {"faults.1.depth": 1e-6, "input_torque": 40.0})],
    ids=["pits", "growth by load"],
)
def test_pits_and_growth_by_load_are_verified_bit_for_bit(tmp_path, scene, changes):
    recording = TwinRecording(tmp_path / "bag", moving_axes=scene.moving_axes)
    twin = pt.Twin(scene, 5_000.0, 1e-3)
    recording.begin(twin, START_NS)
    for number in range(8):
        if number == 4:
            twin.set(**changes)
            recording.point(twin)
        recording.advance(twin, 0.01)
    recording.finish()
    grown = twin.severities["faults.1.depth"]
    assert grown > changes.get("faults.1.depth", 3e-6)
    result = verify(recording.file, NAMESPACE)
    assert result.identical and result.values > 500


def test_the_recording_names_the_severities_that_were_set(worsened):
    (run,) = read_runs(worsened, NAMESPACE, [])
    named = [{n: v for n, v in c.values.items() if n.startswith("faults.")} for c in run.changes]
    assert named == [
        {"faults.0.stiffness_loss": 0.0, "faults.1.depth": 0.0},
        {"faults.0.stiffness_loss": 0.1}, {}, CHANGES[12],
    ]  # fmt: skip
    point = read_recording(worsened).operating_point
    assert str(point["changed"][1]) == "faults.0.stiffness_loss"
    grown = dict(each.split("=") for each in str(point["severities"][2]).split(","))
    assert 0.0 < float(grown["faults.1.depth"]) < 5e-6


def test_a_branch_changes_a_fault_from_a_time_on(worsened, tmp_path):
    branch = Branch({"faults.1.depth": "1 um"}, 0.1)
    result = resimulate(worsened, NAMESPACE, branch, tmp_path / "bag")
    losses = read_recording(result.file).state["power_loss"]
    changed = CHANGES | {12: {"faults.0.stiffness_loss": 0.2}}
    twin, expected = pt.Twin(SCENE, 10_000.0, 1e-3), []
    for number in range(16):
        if number == 10:
            twin.set(**{"faults.1.depth": 1e-6})
        if number in changed:
            twin.set(**changed[number])
        expected.append(twin.advance(0.01).power_loss)
    assert np.array_equal(losses, expected)
    assert verify(result.file, NAMESPACE).identical
