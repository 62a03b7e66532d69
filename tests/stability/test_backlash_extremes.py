"""No play at all, play below the size of an atom, and play wider than a tooth is bent."""

import numpy as np
import pytest
from stability.linear_train import LinearTrain
from stability.sound import PAPER, PLAIN, base_radius, sound_run, static_force, stiffnesses

import planetary_twin_py as pt

PLAYS = pytest.mark.parametrize("backlash", [0.0, 1e-12, 1e-3])
RATTLE = {"input_torque": 0.3, "torque_ripple": 3.0}


@PLAYS
@pytest.mark.parametrize("torque", [63.0, -63.0])
def test_half_the_play_lies_before_the_flank_that_carries(backlash, torque):
    scene = PLAIN.replace(backlash=backlash, input_torque=torque)
    run = sound_run(scene, 0.02, tolerance=1e-8)
    force = static_force(scene)
    play = run.dte - run.mesh_force / stiffnesses(scene)  # steady: damping carries nothing
    assert play == pytest.approx(np.copysign(0.5 * backlash, torque), rel=1e-3, abs=2e-14)
    assert run.mesh_force.mean() == pytest.approx(force, rel=1e-5)


def test_a_play_below_all_motion_is_no_play():
    none, atom = (sound_run(PAPER.replace(backlash=b, **RATTLE), 0.03) for b in (0.0, 1e-12))
    assert none.stats.flank_events > 0
    assert atom.dte == pytest.approx(none.dte, abs=1e-3 * np.abs(none.dte).max())


def test_without_play_and_damping_teeth_are_a_linear_spring():
    """The exact response to a torque up and down, by superposition of two steps."""
    springs = {"mesh.damping.damping_ratio": 0.0, "drive.speed_control.bandwidth": 1e-6}
    scene = PLAIN.replace(backlash=0.0, input_speed=0.0, input_torque=0.0, **springs)
    twin, there, back, steps = pt.Twin(scene, tolerance=1e-7), 5.0, -8.0, 600
    twin.set(input_torque=there)
    up = twin.advance(steps / twin.sample_rate).waveform
    twin.set(input_torque=there + back)
    down = twin.advance(steps / twin.sample_rate).waveform
    train, times = LinearTrain(scene), np.concatenate([up.time, down.time])
    exact = train.after_step(there, times)
    exact[steps:] += train.after_step(back, times[:steps])
    assert exact.min() < 0.0 < exact.max()
    found = np.vstack([up.dte, down.dte])
    assert found == pytest.approx(exact, abs=1e-4 * np.abs(exact).max())


def test_flanks_cross_a_wide_play_as_free_bodies():
    """Motor and sun together: (b - d) = r_b T t^2/(2 J) until the coast flanks meet."""
    stiff = {f"drive.{side}.coupling_stiffness": 1e8 for side in ("input", "output")}
    scene = PLAIN.replace(
        backlash=1e-3, input_speed=0.0, input_torque=0.0,
        **stiff, **{"drive.speed_control.bandwidth": 1e-6},
    )  # fmt: skip
    twin = pt.Twin(scene, tolerance=1e-7)
    twin.set(input_torque=-63.0)
    flight = twin.advance(5e-3).waveform
    sun = scene.gearset.equivalent_mass.sun * (0.5 * scene.gearset.module * 30) ** 2
    inertia = sun + scene.drive.input.inertia
    acceleration = base_radius(scene, 30) * 63.0 / inertia
    crossed = np.sqrt(2.0 * scene.operating_point.backlash / acceleration)
    free = flight.time < crossed - 1.0 / twin.sample_rate
    expected = 0.5e-3 - 0.5 * acceleration * flight.time[free] ** 2
    assert not flight.mesh_force[free].any()
    assert flight.dte[free, :3] == pytest.approx(np.tile(expected[:, None], 3), abs=1e-6)
    landed = flight.time > crossed + 1.0 / twin.sample_rate
    assert flight.mesh_force[landed, :3].max(axis=1)[0] < 0.0


def test_peak_forces_keep_to_tolerance_however_wide_the_backlash():
    """Planets with clearance, whose flanks stay in contact: forces bend teeth by 1 um of 1 mm."""
    scene = PAPER.replace(
        **{
            "dynamics": "planar",
            "gearset.teeth": {"sun": 59, "planet": 22, "ring": 103},
            "gearset.module": 3.264e-3,
            "gearset.pressure_angle": np.deg2rad(20.0),
            "gearset.addendum": 0.8,
            "gearset.face_width": 0.045,
            "gearset.planet_angles": tuple(np.deg2rad([0.0, 120.0, 242.0 + 2.0 / 9.0])),
            "gearset.held": "sun",
            "gearset.equivalent_mass": {"sun": 5.0, "planet": 0.47, "ring": 11.8, "carrier": 2.1},
            "gearset.planet_mass": 1.4,
            "mesh.sun_planet_stiffness": 4.6e8,
            "mesh.planet_ring_stiffness": 5.2e8,
            "mesh.damping.loss_factor": 0.009,
            "lubrication.friction": False,
            "supports": {
                "sun": {"mass": 8.0, "bearing": 2.6e7, "clearance": 5e-6},
                "planet": {"mass": 1.06, "bearing": 3e8, "clearance": 5e-5},
                "ring": {"mass": 6.7, "bearing": 2.7e8},
                "carrier": {"mass": 4.2, "bearing": 3.7e7},
            },
            "drive.input.member": "ring",
            "drive.input.inertia": 3.9,
            "drive.input.coupling_stiffness": 27600.0,
            "drive.input.coupling_damping": 25.0,
            "drive.output.member": "carrier",
            "drive.output.inertia": 0.8,
            "drive.output.coupling_stiffness": 7.3e5,
            "drive.output.coupling_damping": 40.0,
            "backlash": 1e-3,
            "input_speed": -17.0 * np.pi / 30.0,
            "input_torque": 238.0,
        }
    )
    found, exact = (
        pt.simulate(scene, 0.1, 2e4, method, tolerance).mesh["mesh_force_peak"]
        for method, tolerance in (("auto", 1e-4), ("rosenbrock", 1e-6))
    )
    assert found == pytest.approx(exact, rel=1e-3)
