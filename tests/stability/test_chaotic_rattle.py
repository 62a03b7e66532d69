"""Resonance under a light load: teeth hit both flanks, and two runs soon have nothing in common."""

import numpy as np
import pytest
from stability.sound import PAPER, assert_closed, assert_finite

import planetary_twin_py as pt

pytestmark = pytest.mark.slow

CHAOTIC = PAPER.replace(
    input_speed=1100.0,
    input_torque=5.0,
    backlash=1e-6,
    **{"mesh.damping.law": "viscous", "mesh.damping.damping_ratio": 0.01},
)
RATE, SPAN, TRANSIENT = 50_000.0, 0.3, 0.05  # [Hz], [s], [s]
STRETCHES = 10


@pytest.fixture(scope="module")
def runs():
    """At two tolerances, and from a torque that differs by a part in 10^9."""
    disturbed = CHAOTIC.replace(input_torque=5.0 * (1.0 + 1e-9))
    pairs = [(CHAOTIC, 1e-3), (CHAOTIC, 1e-4), (disturbed, 1e-4)]
    return [pt.simulate(scene, SPAN, RATE, tolerance=tolerance) for scene, tolerance in pairs]


def gap(one, two, begin, end):
    """Rms difference of the DTE over its deviation from the mean."""
    part = slice(round(begin * RATE), round(end * RATE))
    return np.sqrt(((one.dte - two.dte)[part] ** 2).mean()) / two.dte.std()


def statistics(run):
    """Means over ten stretches of the run: (stretches, quantities)."""
    late = slice(round(TRANSIENT * RATE), None)
    force, dte, loss = run.mesh_force[late], run.dte[late], run.power_loss[late]
    columns = [force, force**2, force > 0.0, force < 0.0, (dte - dte.mean(axis=0)) ** 2, loss]
    means = [np.mean(column, axis=1) for column in columns]
    return np.array([[part.mean() for part in np.array_split(m, STRETCHES)] for m in means]).T


def test_teeth_part_and_hit_both_flanks(runs):
    for run in runs:
        assert_finite(run)
        assert_closed(run, CHAOTIC)
        assert run.stats.flank_events > 10_000
        assert run.mesh_force.min() < 0.0 < run.mesh_force.max()


def test_paths_agree_at_first_and_then_part(runs):
    coarse, fine, disturbed = runs
    assert gap(disturbed, fine, 0.0, 2e-3) < 1e-4
    for other in (coarse, disturbed):
        assert gap(other, fine, 0.25, 0.3) > 0.5


def test_statistics_agree_though_the_paths_do_not(runs):
    """Within what means of a finite run scatter: four standard errors, which are a few per cent."""
    coarse, fine, disturbed = (statistics(run) for run in runs)
    for other in (coarse, disturbed):
        scatter = (other.var(axis=0, ddof=1) + fine.var(axis=0, ddof=1)) / STRETCHES
        apart = np.abs(other.mean(axis=0) - fine.mean(axis=0))
        assert (apart < 4.0 * np.sqrt(scatter)).all()
        assert (np.sqrt(scatter) < 0.06 * fine.mean(axis=0)).all()


def test_the_mean_force_is_that_of_statics_in_chaos_too(runs):
    """Torque in, less what friction takes, over the base radius of the sun."""
    radius = 0.012 * np.cos(PAPER.gearset.pressure_angle)
    for run in runs:
        late = slice(round(TRANSIENT * RATE), None)
        assert run.mesh_force[late].mean() == pytest.approx(5.0 / (3.0 * radius), rel=0.05)
