"""Soft couplings of a differential's second motor: one equilibrium, or a refusal."""

import re

import numpy as np
import pytest
from power_flows import DIFFERENTIALS, flow_name, scene_of

import planetary_twin_py as pt
from planetary_twin_py._core import (
    NEGLIGIBLE_FORCE,
    advance_shafts,
    first_guess,
    frame_cycle_rate,
    solve_equilibrium,
)
from planetary_twin_py.model.layout import SECOND_MOTOR, Layout
from planetary_twin_py.run.quasi_static.engine import QuasiStaticEngine

SOFT = "drive.second_input.coupling_stiffness"
FLOWS = pytest.mark.parametrize("flow", DIFFERENTIALS, ids=flow_name)


def differential(flow, stiffness):
    return scene_of(flow, dynamics="quasi_static", **{SOFT: stiffness})


def least_stiffness(flow):
    with pytest.raises(ValueError, match="must be at least") as refusal:
        pt.simulate(differential(flow, 1.0), 0.01)
    assert str(refusal.value).startswith(f"{SOFT} = 1 N m/rad: too soft for dynamics")
    return float(re.search(r"at least (\S+) N m/rad", str(refusal.value))[1])


@FLOWS
@pytest.mark.parametrize("stiffness", [1e1, 1e2, 1e3, 1e4, 1e5, 1e6])
def test_samples_and_ledger_agree_or_coupling_is_refused_by_name(flow, stiffness):
    try:
        run = pt.simulate(differential(flow, stiffness), 0.05, sample_rate=2e5)
    except ValueError as refusal:
        assert str(refusal).startswith(f"{SOFT} = {stiffness:g} N m/rad: too soft")
        assert stiffness < 1e3
        return
    energy = run.energy
    assert abs(energy.residual) < 1e-12 * energy.driving_work
    assert abs(run.total_power_loss.mean() * 0.05 - energy.loss) < 1e-6 * energy.driving_work


def torques(flow, stiffness, backwards):
    """Torque of the second motor over a mesh cycle, each equilibrium guessed from the one before.

    The engine is that of a stiff coupling, whose model is then given the soft one.
    """
    engine = QuasiStaticEngine(differential(flow, 1e6), 1e-4)
    model, run = engine.model, first_guess(engine._closing_side)
    model.train.coupling.stiffness[SECOND_MOTOR] *= stiffness / 1e6
    period = 1.0 / abs(frame_cycle_rate(model.train, engine._origin))
    times = np.linspace(0.0, period, 401)
    found = []
    for time in times[::-1] if backwards else times:
        advance_shafts(model, engine._origin, time, run.state)
        solve_equilibrium(model, 1e-6, run)
        found.append(float(run.torque[SECOND_MOTOR]))
    return np.array(found[::-1] if backwards else found)


@FLOWS
def test_the_equilibrium_is_one_from_the_least_stiffness_on(flow):
    least = least_stiffness(flow)
    exact = (
        3 * NEGLIGIBLE_FORCE * Layout(scene_of(flow)).radii["ring"]
    )  # friction of three planets' meshes
    there, back = (torques(flow, least, backwards) for backwards in (False, True))
    assert there == pytest.approx(back, abs=exact)
    there, back = (torques(flow, least / 5.0, backwards) for backwards in (False, True))
    assert np.abs(there - back).max() > 10 * exact


def test_a_twin_refuses_several_equilibria_and_runs_on():
    flow = DIFFERENTIALS[0]
    twin = pt.Twin(differential(flow, 1.2 * least_stiffness(flow)))
    before = twin.advance(0.01).power_loss
    with pytest.raises(ValueError, match=SOFT):
        twin.set(input_torque=500.0)
    assert twin.advance(0.01).power_loss == pytest.approx(before, rel=0.05)
