"""Runs with held axes warn where bearings would change the load shares of the planets."""

import pytest

import planetary_twin_py as pt
from planetary_twin_py.checks.fixed_axes import held_axes_warning, static_shares

FLOATING = pt.load_scene("floating_sun")
HELD = FLOATING.replace(dynamics="torsional")


def test_shares_are_those_of_whole_mesh_cycles():
    held, moving = static_shares(HELD)
    without_supports, with_supports = map(pt.load_sharing, (HELD.replace(supports=None), HELD))
    assert held == pytest.approx(without_supports.share.mean(axis=0), rel=1e-12)
    assert held.max() == pytest.approx(without_supports.mean_factor, rel=1e-12)
    assert moving == pytest.approx(with_supports.share.mean(axis=0), rel=1e-12)
    assert held.sum() == pytest.approx(4.0) and moving.sum() == pytest.approx(4.0)


@pytest.mark.parametrize(
    ("dynamics", "moving"), [("torsional", "planar"), ("quasi_static", "quasi_static_planar")]
)
def test_held_axes_name_shares_and_the_dynamics_that_move_them(dynamics, moving):
    with pytest.warns(
        pt.AccuracyWarning, match=rf"planet 1 carries 3\.67 times .* 1\.16 .* = {moving} or auto"
    ):
        run = pt.simulate(FLOATING.replace(dynamics=dynamics), 0.01)
    force = run.mesh["mesh_force_mean"][:4]
    assert force[0] / force.mean() > 3.0  # what the warning is about


@pytest.mark.parametrize(
    "scene",
    [
        FLOATING,
        HELD.replace(supports=None),
        HELD.replace(input_torque=0.0),
        HELD.replace(**{"errors.pin_tangential": (0.0, 0.0, 0.0, 0.0)}),
        HELD.replace(**{"errors.pin_tangential": (5e-7, 0.0, 5e-7, 0.0)}),  # shares change by 0.03
        pt.load_scene("paper"),
        pt.load_scene("wind_turbine_stage"),
    ],
    ids=["moving", "no supports", "no load", "no errors", "small errors", "paper", "equal planets"],
)
def test_no_warning_where_shares_hardly_differ(scene):
    assert held_axes_warning(scene) is None
