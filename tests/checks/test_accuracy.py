"""Runs whose motion outgrows their tolerance say so, and others say nothing."""

import json
import warnings

import pytest
from command_line import invoke

import planetary_twin_py as pt
from planetary_twin_py.checks.accuracy import accuracy_warnings, course_warnings
from planetary_twin_py.recording.runs.offline import Plan, record
from planetary_twin_py.recording.runs.verify import verify
from planetary_twin_py.run.counters import Course
from planetary_twin_py.studies.axes import Axis
from planetary_twin_py.studies.doubts import inaccuracies
from planetary_twin_py.studies.measures import measure
from planetary_twin_py.studies.plan import Settings, grid
from planetary_twin_py.studies.table import tabulate
from planetary_twin_py.studies.work import Failure

PAPER = pt.load_scene("paper")
RATTLE = {
    "input_speed": 1100.0,
    "input_torque": 5.0,
    "backlash": 1e-6,
    "mesh.damping.law": "viscous",
    "mesh.damping.damping_ratio": 0.01,
}
STOPPING = {
    "input_speed": pt.rpm(100),
    "input_torque": 260.0,
    "mesh.double_pair_ratio": 1.9,
    "mesh.damping.law": "viscous",
    "mesh.ramp": 0.0,
}


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"input_speed": 0.0},
        {"dynamics": "quasi_static", "input_speed": 0.01},
        {"mesh.runout.sun": 3e-6},  # closes 2.2 um of 0.2 um of backlash; the load opens 5 um
    ],
)
def test_a_run_that_keeps_to_its_tolerance_is_not_warned_of(changes):
    with warnings.catch_warnings():
        warnings.simplefilter("error", pt.AccuracyWarning)
        pt.simulate(PAPER.replace(**changes), 0.02)


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"input_speed": pt.rpm(0.01)}, "the gears creep, and friction still depends on"),
        (RATTLE, "flanks engage and separate"),
        (STOPPING, "vibration stops gears"),
    ],
)
def test_a_run_that_may_not_keep_to_it_says_why(changes, reason):
    with pytest.warns(pt.AccuracyWarning, match=reason):
        pt.simulate(PAPER.replace(**changes), 0.02)


# Little damping, 2 mm/s at the pitch point, and no change of stiffness that would excite them.
CREEPING = {
    "input_speed": 0.55,
    "input_torque": 22.0,
    "mesh.sun_planet_stiffness": 6e7,
    "mesh.planet_ring_stiffness": 6e7,
    "mesh.double_pair_ratio": 1.0,
    "mesh.damping": {"law": "viscous", "damping_ratio": 0.01},
    "lubrication.lambda_ratio": "computed",
}
FALLING = {"lubrication.traction": "schlenk"}
CONSTANT = {"lubrication.traction": "table", "lubrication.friction_table": {"coefficient": [0.08]}}


@pytest.mark.parametrize(("law", "vibrates"), [(FALLING, True), (CONSTANT, False)])
def test_creep_is_warned_of_where_friction_falls_with_speed(law, vibrates):
    scene = PAPER.replace(**CREEPING, **law)
    run = pt.simulate(scene, 0.01)
    lines = list(accuracy_warnings(scene, run))
    assert any(line.startswith("vibration stops gears") for line in lines) == vibrates
    planet = run.speed[:, run.bodies.index("planet_1")]
    assert (planet.std() > 0.05 * abs(planet.mean())) == vibrates


@pytest.mark.parametrize("changes", [{"mesh.runout.sun": 4e-5}, {"input_torque": 1.0}])
def test_runout_that_closes_the_backlash_is_refused(changes):
    with pytest.raises(pt.SceneError, match=r"backlash = 2e-07: must be at least .* mesh.runout"):
        PAPER.replace(**{"mesh.runout.sun": 3e-6} | changes)


def test_windows_of_a_twin_add_up_to_the_course_of_the_run():
    scene = PAPER.replace(**RATTLE)
    run, twin, course = pt.simulate(scene, 0.02, tolerance=1e-3), pt.Twin(scene), Course()
    twin = pt.Twin(scene, tolerance=1e-3)
    for _ in range(4):
        course = course.joined(twin.advance(0.005).course)
    stats = run.stats
    assert stats.flank_events > 0
    assert course == Course(stats.flank_events, stats.reversals, stats.repeated_steps)


def test_a_repeating_motion_is_as_accurate_as_its_tolerance():
    rattle = Course(flank_events=100)
    assert len(list(course_warnings(rattle))) == 1
    assert not list(course_warnings(rattle.joined(Course(repeated_steps=1))))


def test_sweep_names_points_whose_errors_may_exceed_tolerance():
    settings = Settings(0.02, 0.0, tolerance=1e-3)
    study = grid(PAPER, [Axis("input_torque", (5.0, 40.0, 63.0))], settings)
    sound, rattling = (measure(scene, settings) for scene in (PAPER, PAPER.replace(**RATTLE)))
    assert list(inaccuracies(tabulate(study, dict.fromkeys(range(3), sound)))) == []
    found = {0: rattling, 1: sound, 2: Failure("no such teeth")}
    (text,) = inaccuracies(tabulate(study, found))
    assert text.startswith("at 1 of 3 points (unrepeated_flank_events), at worst: flanks engage")


def test_verify_names_figures_that_the_tolerance_leaves_open(tmp_path):
    for name, scene, count in (("sound", PAPER, 0), ("rattle", PAPER.replace(**RATTLE), 1)):
        record(Plan(scene, 0.05, 5000.0, 1e-2), tmp_path / name)
        (file,) = (tmp_path / name).glob("*.mcap")
        verdict = verify(file, "/planetary_twin")
        assert verdict.identical and len(verdict.accuracy) == count
        shown = invoke("verify", file, "--json", "-")
        assert len(json.loads(shown.stdout)["accuracy"]) == count
        assert shown.stderr.count("flanks engage and separate") == count


WEDGED = {"planet_thickness": [2e-5, 0.0, 0.0]}


@pytest.mark.parametrize(
    ("errors", "torque"),
    [
        (WEDGED, 63.0),
        ({"pin_radial": [0.0, -2e-6, 0.0]}, 63.0),
        ({"pin_radial": [0.0, -2e-6, 0.0]}, 3.0),
        ({"planet_thickness": [-2e-5, 0.0, 0.0]}, 63.0),
        ({"pin_tangential": [2e-6, 0.0, 0.0]}, 63.0),
    ],
)
def test_a_quasi_static_run_warns_where_both_flanks_carry(errors, torque):
    # Without friction both are the same statics; the other one has forces on both flanks.
    still = {"dynamics": "quasi_static", "lubrication.friction": False, "input_torque": torque}
    scene = PAPER.replace(**still, errors=errors)
    lines = list(accuracy_warnings(scene, pt.simulate(scene, 0.005)))
    assert any("both flanks" in line for line in lines) == pt.load_sharing(scene).both_flanks


def test_each_quasi_static_window_counts_both_flanks():
    twin = pt.Twin(PAPER.replace(dynamics="quasi_static", errors=WEDGED))
    assert all(twin.advance(0.01).course.both_flanks > 0 for _ in range(3))
    twin = pt.Twin(PAPER.replace(dynamics="quasi_static"))
    assert twin.advance(0.01).course.both_flanks == 0
