"""Losses measured on an external rig: see tests/data/compact/README.md."""

from pathlib import Path

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.recording.tables.rig_recording import write_measured
from planetary_twin_py.studies.fit.identify import Search, identify
from planetary_twin_py.studies.fit.remarks import remarks

DATA = Path(__file__).parents[2] / "data" / "compact"
FRICTION, DRAG = "lubrication.boundary_coefficient", "losses.sun_drag.coulomb"


@pytest.fixture(scope="module")
def rig(tmp_path_factory):
    path = tmp_path_factory.mktemp("compact") / "rig"
    write_measured(DATA / "losses.csv", pt.load_scene(DATA / "scene.yaml"), path)
    return path


def drag_by_regression():
    """c of loss/w = c + b (T - c), over all rows: a torque lost before the teeth."""
    _, _, rpm, torque, loss = np.loadtxt(
        DATA / "losses.csv", delimiter=",", skiprows=1, dtype=str
    ).T
    lost = loss.astype(float) / (rpm.astype(float) * np.pi / 30.0)
    slope, intercept = np.polyfit(torque.astype(float), lost, 1)
    return intercept / (1.0 - slope)


@pytest.mark.exhaustive
def test_friction_alone_reaches_the_end_of_its_range_and_the_missing_drag_is_named(rig):
    found = identify(rig, Search((FRICTION,), ("power_loss",)), begin=0.0, end=22.5)
    assert found.estimate.at_bound == (True,) and found.estimate.unbounded[0] > 1.0
    assert found.missing_loss.field == DRAG
    assert found.missing_loss.value == pytest.approx(drag_by_regression(), rel=0.1)
    assert found.missing_loss.sum < 0.01 * found.sum
    said = list(remarks(found))
    assert said[0].startswith(f"{FRICTION}: is at the end of its range, 1; without the range")
    assert said[1].startswith(f"the model lacks a loss: {DRAG} = ")


@pytest.mark.exhaustive
def test_with_a_load_independent_drag_friction_stays_within_its_range(rig):
    found = identify(rig, Search((FRICTION, DRAG), ("power_loss",)), begin=0.0, end=22.5)
    assert found.estimate.at_bound == (False, False)
    low, high, _ = found.estimate.intervals[1]
    assert low < drag_by_regression() < high and high - low < 0.03


def test_one_of_several_operating_points_is_not_chosen_silently(rig):
    found = identify(rig, Search((DRAG,), ("power_loss",)))
    assert any(
        line.startswith("only 1 of 54 operating points is used, 0 to 2.5 s of 135 s")
        for line in remarks(found)
    )
