"""Teeth that creep, hold, break away and turn back, against friction torques in closed form."""

import math

import numpy as np
import pytest
from paths import planet_ring_path, sun_planet_path
from planetary_twin_benchmark.samples import samples_until
from stability.sound import UNIFORM, base_radius, sound_run

import planetary_twin_py as pt
from planetary_twin_py.gearset.geometry import base_pitch
from planetary_twin_py.gearset.phasing import mesh_phases
from planetary_twin_py.model.layout import MOTOR
from planetary_twin_py.run.engine import Engine

MU = 0.02
TORQUE = 63.0
SLOW = pt.rpm(1.5)
# Coulomb friction whatever the film, shafts that do not wind up, a speed that is kept.
COULOMB = UNIFORM.replace(
    input_torque=TORQUE,
    lambda_ratio=0.0,
    input_speed=SLOW,
    **{
        "lubrication.lambda_ratio": "prescribed",
        "lubrication.boundary": "load_sharing",
        "lubrication.boundary_coefficient": MU,
        "drive.input.coupling_stiffness": 1e6,
        "drive.input.coupling_damping": 10.0,
        "drive.output.coupling_stiffness": 1e6,
        "drive.output.coupling_damping": 10.0,
        "drive.speed_control.bandwidth": 100.0,
    },
)


def friction_torque(sun_angle):
    """At the sun [N m]: of each pair mu F |s| d(V/s)/dw, s its distance from the pitch point.

    The pairs of a mesh share its force equally. What friction changes in the forces is left out.
    """
    gears = COULOMB.gearset
    teeth, pitch = gears.tooth_numbers, base_pitch(gears.module, gears.pressure_angle)
    force = TORQUE / (gears.planets * base_radius(COULOMB, teeth.sun))
    turned = {
        sun_planet_path: 1.0 + teeth.sun / teeth.planet,
        planet_ring_path: teeth.sun * (1.0 / teeth.planet - 1.0 / teeth.ring),
    }
    total = 0.0
    for (path, lever), phases in zip(
        turned.items(), mesh_phases(teeth, gears.planet_angles), strict=True
    ):
        ends = path(teeth, gears.pressure_angle, gears.addendum)
        for phase in phases:
            cycle = (sun_angle * teeth.sun / (2.0 * math.pi) - float(phase)) % 1.0
            places = [cycle + n for n in range(-3, 4) if -ends.approach < cycle + n < ends.recess]
            total += MU * force * pitch * lever * float(np.mean(np.abs(places)))
    return total


def work_of(angles):
    """Of friction along a course of the sun's angle [J]."""
    torques = np.array([friction_torque(angle) for angle in angles])
    return float((0.5 * (torques[1:] + torques[:-1]) * np.abs(np.diff(angles))).sum())


@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_creeping_takes_the_work_of_coulomb_friction(direction):
    run = sound_run(COULOMB.replace(input_speed=direction * SLOW), 1.5, 2000.0, tolerance=1e-4)
    assert run.energy.friction == pytest.approx(work_of(run.angle[:, 0]), rel=0.01)


@pytest.mark.parametrize("slower", [10.0, 100.0, 1000.0])
def test_the_loss_of_a_joint_does_not_vanish_with_its_speed(slower):
    """Coulomb friction takes the same share of the power at any speed."""
    run = sound_run(COULOMB.replace(input_speed=SLOW / slower), 0.5, 2000.0, tolerance=1e-4)
    turned = np.abs(np.diff(run.angle[:, 0])).sum()
    assert run.energy.friction / turned == pytest.approx(
        work_of(run.angle[:, 0]) / turned, rel=0.02
    )


def pushed(share, pause=0.6):
    """Speeds of the motor [rad/s] and angles of the sun [rad] as a part of the friction torque is
    put on slowly and stays, the motor being braked by `BRAKE`."""
    engine = Engine(COULOMB.replace(input_speed=0.0), 1e-4)
    operation, sun = engine.model.operation, int(engine.train.sun)
    operation.trim_gain[:] = 0.0
    operation.proportional[MOTOR] = BRAKE
    torque, start = float(operation.torque[MOTOR]), float(engine.sample(0.0).angle[0, sun])
    extra = share * friction_torque(start)
    for step in range(1, 41):
        operation.torque[MOTOR] = torque + extra * step / 40
        engine.sample(0.005 * step)
    seen = samples_until(engine, 0.2 + pause, 401, 2000.0, int(2000 * pause))
    return seen.speed[:, sun], seen.angle[:, sun], extra


BRAKE = 5.0  # [N m s/rad]


@pytest.mark.parametrize("share", [0.5, 0.8, -0.8])
def test_teeth_hold_a_torque_below_that_of_friction(share):
    speed, angle, _ = pushed(share)
    assert abs(speed[-1]) < 1e-6
    assert np.ptp(angle[len(angle) // 2 :]) < 1e-7


@pytest.mark.parametrize("share", [1.1, 1.5, -1.5])
def test_above_it_they_creep_as_fast_as_the_brake_lets_them(share):
    speed, angle, extra = pushed(share)
    torques = np.array([friction_torque(each) for each in angle])
    expected = (extra - math.copysign(1.0, share) * torques) / BRAKE
    late = slice(len(speed) // 2, None)  # pairs at the pitch point have come to slide, too
    assert speed[late] == pytest.approx(expected[late], abs=0.02 * torques[0] / BRAKE)


def test_a_joint_has_a_loop_of_twice_the_friction_torque():
    twin = pt.Twin(COULOMB, tolerance=1e-4)
    work, angles = 0.0, []
    for direction in (1.0, -1.0, 1.0, -1.0):
        twin.set(input_speed=direction * SLOW)
        for _ in range(60):
            window = twin.advance(0.005)
            assert window.power_loss >= 0.0  # what teeth store before they slide is not lost
            work += window.power_loss * 0.005
            angles.append(window.angle[0])
    assert work == pytest.approx(work_of(np.unwrap(angles)), rel=0.03)
