"""Whole runs of the paper's gearbox against its known figures and against scaling laws."""

import numpy as np
import pytest

import planetary_twin_py as pt

PAPER = pt.load_scene("paper")


@pytest.fixture(scope="module")
def steady():
    return pt.simulate(PAPER, 0.2, tolerance=1e-3)


def test_mean_mesh_force_at_63_newton_metres(steady):
    assert steady.mesh_force.mean() == pytest.approx(1878.8, rel=0.01)


def test_efficiency_is_that_of_the_published_correlations(steady):
    assert 0.982 < steady.efficiency < 0.989


def test_ring_turns_at_minus_three_sevenths_of_the_sun(steady):
    sun, ring = (steady.bodies.index(name) for name in ("sun", "ring"))
    turned = steady.angle[-1] - steady.angle[0]
    assert turned[sun] == pytest.approx(pt.rpm(1000) * (steady.time[-1] - steady.time[0]), rel=1e-3)
    assert turned[ring] / turned[sun] == pytest.approx(-3 / 7, rel=1e-4)
    assert not steady.angle[:, -1].any()  # the carrier is held


def test_transmission_error_alternates_with_the_teeth(steady):
    """Its spectrum has lines at multiples of 500 Hz alone."""
    late = steady.dte[-5000:, 0]  # 0.1 s, so that a line is 10 Hz wide
    spectrum = np.abs(np.fft.rfft(late - late.mean())) ** 2
    lines = spectrum[50::50].sum()
    assert lines / spectrum.sum() > 0.99


def test_boundary_friction_and_loss_fall_with_the_lambda_ratio():
    runs = [pt.simulate(PAPER.replace(lambda_ratio=x), 0.02) for x in (1.0, 1.25, 1.5, 1.75, 2.0)]
    boundary = np.array([run.boundary_friction.mean() for run in runs])
    expected = np.array([1.217, 0.662, 0.345, 0.172, 0.082])  # at the pitch point
    assert boundary / boundary[0] == pytest.approx(expected / expected[0], rel=5e-3)
    assert np.all(np.diff([run.total_power_loss.mean() for run in runs]) < 0.0)
    film = [np.nanmean(run.film_thickness) for run in runs]
    assert film == pytest.approx([film[0]] * 5, rel=1e-3)


def test_film_follows_speed_to_the_seven_tenths_and_loss_grows():
    runs = [pt.simulate(PAPER.replace(input_speed=pt.rpm(n)), 0.06) for n in (1000, 2000, 3000)]
    film = np.array([np.nanmean(run.film_thickness) for run in runs])
    assert film / film[0] == pytest.approx([1.0, 2**0.7, 3**0.7], rel=0.02)
    loss = np.array([run.total_power_loss.mean() for run in runs])
    assert np.all(np.diff(loss) > 0.0)
    share = loss / np.array([1, 2, 3])
    assert np.all(np.diff(share) < 0.0)  # as a share of the power, it falls
    assert 1 - runs[2].efficiency == pytest.approx(0.0111, rel=0.05)


def test_force_scales_with_torque_and_backlash_without_friction():
    """Contact loss depends on speed, not load: everything scales, teeth that part as well."""
    stiff = {f"drive.{side}.coupling_stiffness": 1e8 for side in ("input", "output")}
    scene = PAPER.replace(
        **stiff,  # or the couplings would wind up the lighter train to another mesh phase
        **{"lubrication.friction": False, "mesh.damping.law": "viscous"},
        **{"mesh.damping.damping_ratio": 0.01, "input_speed": 780.0},
    )
    heavy = pt.simulate(scene.replace(input_torque=1.0, backlash=1e-7), 0.004, tolerance=1e-6)
    light = pt.simulate(scene.replace(input_torque=0.1, backlash=1e-8), 0.004, tolerance=1e-6)
    assert np.any(heavy.mesh_force == 0.0)
    assert heavy.dte == pytest.approx(10 * light.dte, rel=1e-2, abs=2e-9)


def test_turning_backwards_mirrors_forces_on_the_other_flanks():
    """Reversed torque and speed: power flows forwards, on the coast flanks."""
    run = pt.simulate(PAPER.replace(input_torque=-63.0, input_speed=pt.rpm(-1000)), 0.05)
    assert run.mesh_force.mean() == pytest.approx(-1878.8, rel=0.01)
    assert 0.982 < run.efficiency < 0.989


@pytest.mark.parametrize(
    "arguments, named",
    [
        ({"duration": -1.0}, r"^duration = -1\.0 s: must be above 0 s$"),
        ({"duration": 1e6}, "duration"),
        ({"duration": 0.1, "sample_rate": 1.0}, "sample_rate"),
        ({"duration": 0.1, "method": "euler"}, "method"),
        ({"duration": 0.1, "tolerance": 1.0}, "tolerance"),
    ],
)
def test_arguments_out_of_range_are_refused_by_name(arguments, named):
    with pytest.raises(ValueError, match=named) as error:
        pt.simulate(PAPER, **arguments)
    assert "\n" not in str(error.value)


def test_dir_lists_the_public_names():
    assert dir(pt) == sorted(pt.__all__)


def test_gears_held_by_their_load_have_a_mean_speed_of_zero():
    still = {"dynamics": "planar", "operating_point.input_speed": 0.0}
    run = pt.simulate(pt.load_scene("floating_sun").replace(**still), 0.01)
    assert run.angle[0].any() and not run.mean_speed.any()
