"""The load sharing factor of a run is that of statics: the largest mean over a mesh cycle."""

import numpy as np
import pytest
from planar.moving_scenes import planar
from power_flows import FLOWS

import planetary_twin_py as pt
from planetary_twin_py.explanation.turning import turning_warnings
from planetary_twin_py.model.layout import Layout
from planetary_twin_py.run.axes.load_shares import CycleShares
from planetary_twin_py.simulation.threads import Threads
from planetary_twin_py.studies.axes import Axis
from planetary_twin_py.studies.plan import Settings, grid
from planetary_twin_py.studies.sweep import sweep
from planetary_twin_py.studies.turning import turning_of_study

SMOOTH = {"dynamics": "quasi_static_planar", "lubrication.friction": False}
CARRIER_HELD, RING_HELD = FLOWS[0], FLOWS[2]


def turning_scene(kind, **changes):
    """Shares that change over a turn of the sun, or over one of the carrier."""
    if kind == "runout":
        errors = {"mesh.runout.sun": 2e-5, "errors.pin_tangential": [-2e-5, 0.0, 0.0]}
        return planar(CARRIER_HELD, **SMOOTH, **errors, **changes)
    offset = {"errors.ring_offset": {"size": 2e-5, "angle": 0.3}}
    return planar(RING_HELD, **SMOOTH, **offset, **changes)


def turn(scene, kind):
    """Time of the turn [s]."""
    speed = scene.operating_point.input_speed
    ratio = Layout(scene).ratios["carrier"][0]
    return 2.0 * np.pi / abs(speed * (1.0 if kind == "runout" else float(ratio)))


@pytest.mark.parametrize("kind", ["runout", "offset"])
def test_the_factor_of_a_whole_turn_is_that_of_statics(kind):
    scene = turning_scene(kind)
    static, time = pt.load_sharing(scene), turn(scene, kind)
    assert static.mean_factor > 1.09
    run = pt.simulate(scene, 1.01 * time, sample_rate=1000.0)
    assert run.axes.load_sharing_factor == pytest.approx(static.mean_factor, abs=2e-3)
    means = static.share.mean(axis=0)
    assert run.axes.mean_load_share == pytest.approx(means, abs=0.01)
    if kind == "offset":
        assert means == pytest.approx(1.0, abs=0.02)
    window = pt.Twin(scene, sample_rate=50_000.0).advance(1.01 * time)
    assert window.axes.load_sharing_factor == pytest.approx(static.mean_factor, abs=2e-3)
    assert list(turning_warnings(scene, run)) == []


@pytest.mark.parametrize("kind", ["runout", "offset"])
def test_part_of_turn_is_reported_with_the_field_and_a_duration(kind):
    scene = turning_scene(kind)
    time = turn(scene, kind)
    (line,) = turning_warnings(scene, pt.simulate(scene, 0.5 * time))
    field = {"runout": "mesh.runout.sun", "offset": "errors.ring_offset"}[kind]
    assert line.startswith(f"{field} changes the load shares over a turn")
    assert "covers 0.5 of one" in line and f"use {time:.4g} s and more" in line


def test_a_study_reports_points_that_cover_a_part_of_a_turn():
    scene = turning_scene("runout")
    time = turn(scene, "runout")
    speed = scene.operating_point.input_speed
    axis = Axis("input_speed", (0.5 * speed, speed))
    study = grid(scene, [axis], Settings(duration=1.01 * time, settling=0.0))
    table = sweep(study, Threads())
    assert table["error_turns"].to_pylist() == pytest.approx([0.505, 1.01], rel=1e-3)
    expected = pt.load_sharing(scene).mean_factor
    assert table["load_sharing_factor"].to_pylist()[1] == pytest.approx(expected, abs=2e-3)
    (line,) = turning_of_study(table)
    assert line.startswith("at 1 of 2 points (error_turns)") and "down to 0.5" in line


def test_no_largest_share_before_a_cycle_or_without_load():
    assert CycleShares(2).largest() is None
    for cycles, load in ((np.linspace(0.0, 0.9, 99), 1.0), (np.linspace(0.0, 9.0, 999), 0.0)):
        shares = CycleShares(2)
        shares.add(cycles, np.full((len(cycles), 2), load))
        assert shares.largest() is None
    unknown = CycleShares(2)
    unknown.add(np.linspace(0.0, 9.0, 999), np.full((999, 2), np.nan))
    assert unknown.largest() is None
