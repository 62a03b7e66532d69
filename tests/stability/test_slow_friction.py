"""Gears that turn slowly: friction is stiff, and the loss still keeps to the tolerance."""

from functools import cache

import pytest
from stability.sound import PAPER, turnover
from tiers import first

import planetary_twin_py as pt

ABRUPT = {"mesh.damping.law": "viscous", "mesh.ramp": 0.0}
CASES = {
    "20 rpm, 200 N m": {**ABRUPT, "input_speed": pt.rpm(20), "input_torque": 200.0},
    "50 rpm, 200 N m": {**ABRUPT, "input_speed": pt.rpm(50), "input_torque": 200.0},
    "20 rpm, 63 N m": {"mesh.damping.law": "viscous", "input_speed": pt.rpm(20)},
    "5 rpm, 63 N m": {"input_speed": pt.rpm(5)},
}
DURATION = 0.3
SLOWEST = "20 rpm, 200 N m"  # its reference takes ten times as long as another's
SOME_CASES = [
    pytest.param(case, marks=pytest.mark.exhaustive if case == SLOWEST else ()) for case in CASES
]


@cache
def run_of(case, tolerance, method):
    return pt.simulate(
        PAPER.replace(**CASES[case]), DURATION, 20_000.0, tolerance=tolerance, method=method
    )


@pytest.mark.parametrize("case", SOME_CASES)
@pytest.mark.parametrize("tolerance", first(1, [1e-2, 3e-3, 1e-3]))
def test_loss_and_transmission_error_keep_to_the_tolerance(case, tolerance):
    """Against the other method, converged."""
    run, exact = run_of(case, tolerance, "auto"), run_of(case, 1e-6, "rosenbrock")
    assert run.mean_power_loss == pytest.approx(exact.mean_power_loss, rel=10 * tolerance)
    for name in ("dte_mean", "mesh_force_mean"):
        assert run.mesh[name] == pytest.approx(exact.mesh[name], rel=10 * tolerance)


@pytest.mark.parametrize("case", CASES)
def test_the_ledger_closes_at_every_tolerance(case):
    for tolerance in (1e-2, 1e-3, 1e-4):
        run = run_of(case, tolerance, "auto")
        assert abs(run.energy.residual) < 1e-4 * turnover(run.energy)
