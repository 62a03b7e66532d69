"""Means and peaks of axes over a run are those of dense samples, whatever samples are kept."""

import numpy as np
import pytest
from planar.moving_scenes import planar

import planetary_twin_py as pt
from planetary_twin_py.run import whole_run

SETTLING, SPAN = 0.0033, 0.01


def spatial():
    return pt.load_scene("helical_stage")


@pytest.mark.parametrize("make", [planar, spatial])
def test_means_and_peaks_of_axes_do_not_depend_on_samples_kept(make, monkeypatch):
    scene = make()
    few, dense = (pt.simulate(scene, SPAN, rate, settling=SETTLING) for rate in (700.0, 800_000.0))
    found, axes = few.axes.statistics, dense.axes
    assert len(few.time) == 7 and few.time == pytest.approx(np.arange(3, 10) / 700.0)
    moved = np.linalg.norm(axes.displacement, axis=2)
    assert found.displacement_peak == pytest.approx(moved.max(axis=0), rel=1e-3)
    force = np.linalg.norm(axes.bearing_force, axis=2)
    assert found.bearing_force_peak == pytest.approx(force.max(axis=0), rel=1e-3)
    assert found.displacement_magnitude == pytest.approx(moved.mean(axis=0), rel=1e-3)
    assert found.bearing_force_magnitude == pytest.approx(force.mean(axis=0), rel=1e-3)
    mean = axes.bearing_force.mean(axis=0)
    assert np.abs(found.bearing_force_mean - mean).max() < 1e-3 * force.max()
    tilting = found.tilting
    assert (tilting is None) == (make is planar)
    if tilting is not None:
        thrust = axes.tilting.axial_force
        assert np.abs(tilting.axial_force_mean - thrust.mean(axis=0)).max() < 1e-3 * thrust.max()
        moment = np.linalg.norm(axes.tilting.tilting_moment, axis=2)
        assert tilting.tilting_moment_peak == pytest.approx(moment.max(axis=0), rel=1e-3)
        assert tilting.tilting_moment_magnitude == pytest.approx(moment.mean(axis=0), rel=1e-3)
        tilt = np.linalg.norm(axes.tilting.tilt, axis=2).mean(axis=0)
        assert tilting.tilt_magnitude == pytest.approx(tilt, rel=1e-3)
    monkeypatch.setattr(whole_run, "MOST_AT_ONCE", 97)
    parts = pt.simulate(scene, SPAN, 700.0, settling=SETTLING)
    assert np.array_equal(parts.axes.displacement, few.axes.displacement)
    assert parts.axes.statistics.displacement_peak == pytest.approx(found.displacement_peak)
