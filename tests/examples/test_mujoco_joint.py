"""The twin as the gear of a MuJoCo joint: inertia, backlash, energy and stability at 1 kHz."""

import math
import sys
from pathlib import Path

import numpy as np
import pytest
from docs.blocks import ROOT
from examples.two_mass_joint import TwoMasses

import planetary_twin_py as pt
from planetary_twin_py.model.gearbox import Gearbox

mujoco = pytest.importorskip("mujoco")
sys.path.insert(0, str(Path(ROOT) / "docs" / "examples"))
from mujoco_joint import STEP, GearedJoint, arm  # noqa: E402

RATIO = 6.0
LINK = 0.05  # inertia of the arm about its joint [kg m^2]
NO_LOSS = {
    "lubrication.friction": False,
    "losses.sun_drag.coulomb": 0.0,
    "losses.sun_drag.viscous": 0.0,
}


@pytest.fixture(scope="module")
def scene():
    return pt.load_scene(ROOT / "docs" / "examples" / "geared_joint.yaml")


def motor_inertia(scene):
    """Of the motor and all gears, carried to the output: J/r^2 of every body [kg m^2]."""
    bodies = Gearbox(scene).bodies
    squares = bodies.copies * bodies.mass * (bodies.radius * bodies.ratio[:, 0]) ** 2
    own = np.delete(squares, [bodies.place["load"], len(squares) - 1])
    return RATIO**2 * float(own.sum())


def test_a_motor_moves_the_joint_as_an_ideal_gear(scene):
    lossless = scene.replace(backlash=0.0, **NO_LOSS)
    joint, count, torque = GearedJoint(arm(), "elbow", lossless), 400, 0.3
    for _ in range(count):
        joint.step(torque)
    ideal = arm()
    ideal.dof_armature[0] = motor_inertia(lossless)
    data = mujoco.MjData(ideal)
    for _ in range(count):
        data.qfrc_applied[0] = RATIO * torque
        mujoco.mj_step(ideal, data)
    speed = RATIO * torque * count * STEP / (LINK + motor_inertia(lossless))
    assert data.qvel[0] == pytest.approx(speed, rel=1e-9)
    # Within a step the speed of the shaft is constant: its angle is a step^2/12 aside in the mean.
    aside = STEP**2 * scene.drive.output.coupling_stiffness / LINK / 12.0
    assert joint.data.qvel[0] == pytest.approx(speed, rel=aside)


def test_the_joint_turns_exactly_as_the_shaft_of_the_twin(scene):
    joint = GearedJoint(arm(), "elbow", scene)
    apart = joint.ports.output_angle
    for n in range(500):
        joint.step(0.5 * math.sin(0.02 * n))
    assert abs(joint.data.qpos[0]) > 0.01
    assert joint.ports.output_angle - joint.data.qpos[0] == pytest.approx(apart, abs=1e-12)


@pytest.mark.parametrize("integral", [0.0, 200.0])
def test_position_loop_has_limit_cycle_of_two_masses_with_play(scene, integral):
    """The controller reads the joint and damps by the motor speed: with backlash it oscillates."""
    lossless = scene.replace(**NO_LOSS)
    target, count = 0.02, 3000

    def controller():
        total = 0.0

        def torque(angle, motor_speed):
            nonlocal total
            total += (target - angle) * STEP
            return 60.0 * (target - angle) + integral * total - motor_speed

        return torque

    law, joint, angles = controller(), GearedJoint(arm(), "elbow", lossless), []
    for _ in range(count):
        torque = law(joint.data.qpos[0], joint.ports.input_speed / RATIO)
        joint.step(torque / RATIO)
        angles.append(joint.data.qpos[0])
    # Both meshes have the backlash of the scene, along the line of action.
    gears = lossless.gearset
    radius = gears.geometry.centre_distance * math.cos(gears.pressure_angle)
    half_play = lossless.operating_point.backlash / radius / 2.0
    masses = TwoMasses(motor_inertia(lossless), LINK, half_play, 1500.0, 0.3)
    expected = masses.course(controller(), STEP, count)
    found, wanted = (cycle_of(np.array(each)[2000:]) for each in (angles, expected))
    assert found[0] == pytest.approx(wanted[0], rel=0.01)
    assert found[1] == pytest.approx(wanted[1], rel=0.05)
    assert found[1] > half_play


def cycle_of(angle):
    """Period [s] and amplitude [rad] of an oscillation, from its upward crossings."""
    beside = angle - 0.5 * (angle.max() + angle.min())
    at = np.flatnonzero((beside[:-1] < 0.0) & (beside[1:] >= 0.0))
    crossing = at - beside[at] / (beside[at + 1] - beside[at])
    return STEP * float(np.diff(crossing).mean()), float(np.ptp(angle)) / 2.0


def exchanged(scene, step):
    """Work of the motor, at the output port and on the joint in 0.5 s, and the joint's energy."""
    joint = GearedJoint(arm(step=step), "elbow", scene)
    motor = port = on_joint = 0.0
    for n in range(round(0.5 / step)):
        before, speed, angle = joint.ports.copy(), joint.data.qvel[0], joint.ports.input_angle
        torque = 0.5 * math.sin(2.0 * math.pi * 4.0 * n * step)
        shown = joint.step(torque)
        turned = step * joint.data.qvel[0]
        motor += torque * (shown.input_angle - angle)
        port -= 0.5 * (before.output_torque + shown.output_torque) * turned
        on_joint -= before.output_torque * 0.5 * (speed + joint.data.qvel[0]) * step
    return motor, port, on_joint, 0.5 * LINK * joint.data.qvel[0] ** 2


def test_no_energy_is_lost_between_the_twin_and_mujoco(scene):
    """The energy that leaves the port reaches the joint; the error falls with the step."""
    gaps = []
    for step in (STEP, STEP / 4.0):
        motor, port, on_joint, kinetic = exchanged(scene, step)
        assert on_joint == pytest.approx(kinetic, rel=1e-9)
        gaps.append(abs(port - on_joint) / motor)
    assert gaps[0] < 1e-3
    assert gaps[1] < gaps[0]


def test_an_undamped_shaft_does_not_gain_energy_at_1_khz(scene):
    """After an impact, the momentum is constant and vibration does not grow in 5 s."""
    lossless = scene.replace(backlash=0.0, **NO_LOSS, **{"drive.output.coupling_damping": 0.0})
    joint = GearedJoint(arm(), "elbow", lossless)
    joint.data.qvel[0] = 0.5
    speeds = np.array([(joint.step(0.0), joint.data.qvel[0])[1] for _ in range(5000)])
    common = 0.5 * LINK / (LINK + motor_inertia(lossless))
    late, early = (np.ptp(part) for part in (speeds[-500:], speeds[:500]))
    # A torque that is known once a step misses up to a step of its impulse.
    torque = 0.5 * math.sqrt(2000.0 * motor_inertia(lossless))
    assert speeds[-2000:].mean() == pytest.approx(common, abs=STEP * torque / LINK)
    assert late <= early
