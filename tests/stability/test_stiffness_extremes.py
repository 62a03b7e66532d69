"""Teeth of rubber, teeth that hardly yield, and both in one gearset."""

import numpy as np
import pytest
from stability.sound import (
    PAPER,
    PLAIN,
    base_radius,
    sound_run,
    static_force,
    stiffnesses,
    turnover,
)

import planetary_twin_py as pt

BOTH = ("mesh.sun_planet_stiffness", "mesh.planet_ring_stiffness")
PAIRS = pytest.mark.parametrize(
    "pair",
    [(1.5e3, 1.5e3), (1e12, 1e12), (1.5e3, 1.5e9), (1.5e9, 1.5e3), (1e12, 1e6), (1e6, 1e12)],
    ids=lambda pair: f"{pair[0]:g}-{pair[1]:g}",
)
RIGID_SHAFTS = {f"drive.{side}.coupling_stiffness": 1e6 for side in ("input", "output")}
SLIGHT = 1e-3  # [N m], which bends the softest teeth by a fiftieth of a millimetre


def with_stiffness(scene, pair):
    return scene.replace(**dict(zip(BOTH, pair, strict=True)))


@PAIRS
@pytest.mark.parametrize("law", ["viscous", "printed_meshing_frequency"])
def test_at_rest_the_transmission_error_is_force_over_stiffness(pair, law):
    scene = with_stiffness(PLAIN, pair).replace(
        input_speed=0.0, input_torque=SLIGHT, **{"mesh.damping.law": law}
    )
    run = sound_run(scene, 0.01)
    bent = run.dte[-1] - 0.5 * scene.operating_point.backlash
    resolved = 1e-15  # [m], of a difference of the two
    assert bent == pytest.approx(static_force(scene) / stiffnesses(scene), rel=1e-6, abs=resolved)


@PAIRS
@pytest.mark.parametrize("law", ["viscous", "meshing_frequency"])
def test_running_what_meshes_do_not_carry_accelerates_the_sun(pair, law):
    """Angular impulse: T t = r_b sum of the integrals of F + (J_motor + J_sun) growth of speed."""
    scene = with_stiffness(PAPER, pair).replace(
        input_torque=SLIGHT if min(pair) < 1e6 else 63.0,
        **RIGID_SHAFTS,
        **{
            "lubrication.friction": False,
            "mesh.damping.law": law,
            "drive.speed_control.bandwidth": 1e-6,
        },
    )
    run = sound_run(scene, 0.05, 100_000.0, tolerance=1e-7)
    gears = scene.gearset
    sun = gears.equivalent_mass.sun * (0.5 * gears.module * gears.teeth.sun) ** 2
    elapsed = run.time[-1] - run.time[0]
    carried = base_radius(scene, gears.teeth.sun) * run.mesh_force[:, : gears.planets].sum(axis=1)
    gained = (scene.drive.input.inertia + sun) * (run.speed[-1, 0] - run.speed[0, 0])
    torque = scene.operating_point.input_torque
    assert np.trapezoid(carried, run.time) + gained == pytest.approx(torque * elapsed, rel=1e-2)


@pytest.mark.parametrize("stiffness", [1e10, 1e13])
def test_stiff_teeth_turn_as_rigid_ones(stiffness):
    """Without a shaft to swing on, the ring turns as Willis says and flanks just touch."""
    scene = with_stiffness(PLAIN, (stiffness, stiffness)).replace(**RIGID_SHAFTS)
    run = sound_run(scene, 0.02)
    ratio = (run.angle[:, 4] - run.angle[0, 4])[1:] / (run.angle[:, 0] - run.angle[0, 0])[1:]
    assert ratio == pytest.approx(-3 / 7, rel=1e-6)
    half, bent = 0.5 * scene.operating_point.backlash, static_force(scene) / stiffness
    assert np.abs(run.dte - half).max() < 5.0 * bent


@pytest.mark.parametrize("stiffness", [3e3, 1e6, 1e8])
@pytest.mark.parametrize(
    "changes", [{}, {"input_speed": 800.0, "input_torque": 5.0, "torque_ripple": 20.0}]
)
def test_a_light_load_that_swings_at_54_khz_converges(stiffness, changes):
    """Without damping of the coupling; against the other method at a tighter tolerance."""
    load = {
        "drive.output.coupling_stiffness": stiffness,
        "drive.output.coupling_damping": 0.0,
        "drive.output.inertia": stiffness / (2.0 * np.pi * 54e3) ** 2,
    }
    scene = PAPER.replace(**load, **changes)
    exact = pt.simulate(scene, 0.005, tolerance=1e-6, method="rosenbrock")
    run = pt.simulate(scene, 0.005, tolerance=1e-5)
    assert np.sqrt(np.mean((run.dte - exact.dte) ** 2) / np.mean(exact.dte**2)) < 1e-4
    losses = [each.mesh["power_loss"].sum() for each in (run, exact)]
    assert losses[0] == pytest.approx(losses[1], rel=1e-4)
    assert abs(run.energy.residual) < 1e-6 * turnover(run.energy)
