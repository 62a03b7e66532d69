"""Means, rms and peaks come from the integrator: neither samples nor windows change them."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt

PAPER = pt.load_scene("paper")
RATES = (10.0, 370.0, 6250.0, 50_000.0, 1e6)
WEAR = {"faults": [{"kind": "wear", "gear": "sun", "tooth": 7, "depth": "4 um"}]}
SCENES = {
    "paper": {},
    "slow": {"input_speed": pt.rpm(60)},
    "without_friction": {"lubrication.friction": False},
    "computed_lambda": {"lubrication.lambda_ratio": "computed"},
    "quasi_static": {"dynamics": "quasi_static"},
    "quasi_static_wear": {"dynamics": "quasi_static", **WEAR},
    "rattling": {"input_torque": 0.3, "torque_ripple": 1.0, "input_speed": pt.rpm(2000)},
}


def statistics(run):
    return np.array([run.mesh[name] for name in sorted(run.mesh)])


@pytest.mark.parametrize("dynamics", ["torsional", "quasi_static"])
def test_a_run_has_the_same_statistics_at_any_sample_rate(dynamics):
    scene = PAPER.replace(dynamics=dynamics)
    runs = [pt.simulate(scene, 0.2, rate) for rate in RATES]
    for run in runs[1:]:
        assert statistics(run) == pytest.approx(statistics(runs[0]), rel=1e-12, nan_ok=True)
        assert run.mean_power_loss == pytest.approx(runs[0].mean_power_loss, rel=1e-12)
        assert run.mesh_efficiency == pytest.approx(runs[0].mesh_efficiency, rel=1e-12)


@pytest.mark.parametrize("dynamics", ["torsional", "quasi_static"])
def test_a_window_has_the_same_statistics_at_any_sample_rate(dynamics):
    scene, found = PAPER.replace(dynamics=dynamics), []
    for rate in RATES:
        twin = pt.Twin(scene, rate)
        found.append([statistics(twin.advance(length)) for length in (0.05, 0.01, 3.3e-3, 1e-6)])
    for other in found[1:]:
        for one, first in zip(other, found[0], strict=True):
            assert one == pytest.approx(first, rel=1e-12, nan_ok=True)


@pytest.mark.parametrize("name", SCENES)
def test_statistics_are_those_of_very_many_samples(name):
    """Within 1e-3; within 2e-3 where flanks part amid a step, as friction has a kink there."""
    run = pt.simulate(PAPER.replace(**SCENES[name]), 0.1, 1e6, settling=0.02)
    seen, rel = run.mesh, 2e-3 if name == "rattling" else 1e-3
    touching = run.mesh_force != 0.0
    expected = {
        "dte_mean": run.dte.mean(axis=0),
        "dte_rms": run.dte.std(axis=0),
        "mesh_force_mean": run.mesh_force.mean(axis=0),
        "contact_fraction": touching.mean(axis=0),
        "film_thickness": np.nanmean(run.film_thickness, axis=0),
        "lambda_ratio": np.nanmean(run.lambda_ratio, axis=0),
        "boundary_friction": run.boundary_friction.mean(axis=0),
        "viscous_friction": run.viscous_friction.mean(axis=0),
        "power_loss": run.power_loss.mean(axis=0),
    }
    for quantity, values in expected.items():
        assert seen[quantity] == pytest.approx(values, rel=rel, abs=1e-15), quantity
    for peak, samples in (("dte_peak", run.dte), ("mesh_force_peak", run.mesh_force)):
        assert seen[peak] == pytest.approx(np.abs(samples).max(axis=0), rel=1e-2), peak
    clipped = touching & (run.viscous_friction == 0.0)
    assert seen["without_viscous"] == pytest.approx(clipped.mean(axis=0), abs=0.02)


@pytest.mark.parametrize("changes", SCENES.values(), ids=SCENES)
def test_losses_of_the_meshes_add_up_to_the_energy_ledger(changes):
    run = pt.simulate(PAPER.replace(**changes), 0.04, 1000.0, settling=0.01)
    lost = run.mesh["power_loss"].sum() * run.duration
    assert lost == pytest.approx(run.energy.friction, rel=1e-4, abs=1e-12)


def test_rosenbrocks_method_has_the_same_statistics():
    one, other = (
        pt.simulate(PAPER, 0.05, 1000.0, method=method) for method in ("march", "rosenbrock")
    )
    assert statistics(one) == pytest.approx(statistics(other), rel=3e-3, abs=1e-12)


def test_a_repeated_cycle_counts_as_one_that_is_computed():
    one, other = (
        pt.simulate(PAPER, 0.5, 1000.0, method=method, settling=2.5) for method in ("auto", "march")
    )
    assert one.stats.repeated_steps > 0 and other.stats.repeated_steps == 0
    assert statistics(one) == pytest.approx(statistics(other), rel=1e-3)
    assert one.time == pytest.approx(other.time)


def test_weighted_windows_add_up_to_the_run():
    twin, run = pt.Twin(PAPER, tolerance=1e-4), pt.simulate(PAPER, 0.2, 1000.0)
    windows = [twin.advance(0.01) for _ in range(20)]
    for name in ("dte_mean", "mesh_force_mean", "power_loss", "film_thickness"):
        mean = np.mean([window.mesh[name] for window in windows], axis=0)
        assert mean == pytest.approx(run.mesh[name], rel=2e-3)
    for name in ("dte_peak", "mesh_force_peak"):
        peak = np.max([window.mesh[name] for window in windows], axis=0)
        assert np.array_equal(peak, run.mesh[name])


def test_settling_leaves_the_start_out_and_changes_no_sample():
    whole, late = pt.simulate(PAPER, 0.05), pt.simulate(PAPER, 0.02, settling=0.03)
    assert np.array_equal(late.time, whole.time[1500:])
    assert np.array_equal(late.dte, whole.dte[1500:])
    assert late.duration == pytest.approx(0.02, abs=1e-3)
    assert late.energy.residual == pytest.approx(0.0, abs=1e-3 * late.energy.driving_work)
    for settling in (-0.1, math.inf, math.nan):
        with pytest.raises(ValueError, match=r"^settling = "):
            pt.simulate(PAPER, 0.01, settling=settling)


@pytest.mark.parametrize("settling", [0.0, 0.01])
@pytest.mark.parametrize("tolerance", [1e-3, 1e-5])
def test_mean_loss_of_short_run_covers_time_that_was_asked_for(tolerance, settling):
    """While the speed rises, the loss of a further part of a step would show."""
    scene = pt.load_scene("run_up")
    run, exact = (
        pt.simulate(scene, 0.02, tolerance=each, settling=settling) for each in (tolerance, 1e-7)
    )
    assert run.duration == 0.02
    assert run.mean_power_loss == pytest.approx(exact.mean_power_loss, rel=1e-4)
