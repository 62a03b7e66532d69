"""Losses measured on an external rig: see tests/data/compact/README.md."""

from pathlib import Path

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.recording.tables.rig_recording import write_measured
from planetary_twin_py.studies.fit.identify import Search, identify
from planetary_twin_py.studies.fit.remarks import remarks

DATA = Path(__file__).parents[2] / "data" / "compact"
FITTED, FITTED_ROWS = 22.5, 45  # [s], of one row each 0.5 s
FRICTION, DRAG = "lubrication.boundary_coefficient", "losses.sun_drag.coulomb"


@pytest.fixture(scope="module")
def rig(tmp_path_factory):
    path = tmp_path_factory.mktemp("compact") / "rig"
    write_measured(DATA / "losses.csv", pt.load_scene(DATA / "scene.yaml"), path)
    return path


def drag_by_regression():
    """c of loss/w = c + b (T - c), over the fitted rows: a torque lost before the teeth."""
    columns = 0, 2, 3, 4
    time, rpm, torque, loss = np.loadtxt(
        DATA / "losses.csv", delimiter=",", skiprows=1, usecols=columns
    )[:FITTED_ROWS].T
    assert time[-1] == FITTED
    slope, intercept = np.polyfit(torque, loss / (rpm * np.pi / 30.0), 1)
    return intercept / (1.0 - slope)


@pytest.mark.exhaustive
def test_friction_at_the_end_of_its_range_names_missing_drag(rig):
    found = identify(rig, Search((FRICTION,), ("power_loss",)), begin=0.0, end=FITTED)
    assert found.estimate.at_bound == (True,) and found.estimate.unbounded[0] > 1.0
    assert found.missing_loss.field == DRAG
    assert found.missing_loss.value == pytest.approx(drag_by_regression(), rel=0.1)
    assert found.missing_loss.sum < 0.01 * found.sum
    said = list(remarks(found))
    assert said[0].startswith(f"{FRICTION}: is at the end of its range, 1; without the range")
    assert said[1].startswith(f"the model lacks a loss: {DRAG} = ")


@pytest.mark.release
def test_with_a_drag_friction_stays_within_its_range(rig):
    found = identify(rig, Search((FRICTION, DRAG), ("power_loss",)), begin=0.0, end=FITTED)
    assert found.estimate.at_bound == (False, False)
    low, high, _ = found.estimate.intervals[1]
    assert low < drag_by_regression() < high and high - low < 0.03


def test_one_of_several_operating_points_is_not_chosen_silently(rig):
    found = identify(rig, Search((DRAG,), ("power_loss",)))
    assert any(
        line.startswith("only 1 of 54 operating points is used, 0 to 2.5 s of 135 s")
        for line in remarks(found)
    )
