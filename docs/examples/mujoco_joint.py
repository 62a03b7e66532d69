"""A joint of a MuJoCo model whose gear is the twin in place of an ideal one.

MuJoCo integrates the link; the twin integrates the motor, the gears and their friction. In every
step, the output shaft gets the speed of the joint, and its torque acts on the joint.
"""

from __future__ import annotations

import sys

import mujoco
import numpy as np

import planetary_twin_py as pt

STEP = 1e-3  # [s]
ARM = """
<mujoco>
  <option timestep="{step}" gravity="0 0 {gravity}"/>
  <worldbody>
    <body>
      <joint name="elbow" type="hinge" axis="0 1 0"/>
      <inertial pos="{arm} 0 0" mass="{mass}" diaginertia="{inertia} {inertia} {inertia}"/>
    </body>
  </worldbody>
</mujoco>
"""


def arm(step: float = STEP, gravity: float = 0.0) -> mujoco.MjModel:
    """Build an arm of 1 kg with its centre 0.2 m from a horizontal axis.

    Args:
        step: time step of MuJoCo [s].
        gravity: gravity along z [m/s^2].

    Returns:
        The model, with an inertia of 0.05 kg m^2 about its joint `elbow`.
    """
    text = ARM.format(step=step, gravity=gravity, arm=0.2, mass=1.0, inertia=0.01)
    return mujoco.MjModel.from_xml_string(text)


class GearedJoint:
    """A hinge that a motor drives through a gearbox.

    Args:
        model: model of MuJoCo; the gearbox replaces actuator, armature and friction of the joint.
        joint: name of the hinge, which is at rest at the start.
        scene: scene of the gearbox; its input port becomes `torque`, its output port `motion`.

    Raises:
        ValueError: the time step of MuJoCo is too long for the joint on the spring of the output
            coupling.
    """

    def __init__(self, model: mujoco.MjModel, joint: str, scene: pt.Scene) -> None:
        self.model, self.data = model, mujoco.MjData(model)
        self._at = int(model.joint(joint).dofadr[0])
        inertia = float(model.dof_M0[self._at])  # that the joint moves, at the start
        stiffness, step = scene.drive.output.coupling_stiffness, float(model.opt.timestep)
        if step**2 * stiffness > inertia:
            raise ValueError(
                f"timestep = {step:g} s: must be at most {np.sqrt(inertia / stiffness):.3g} s for "
                f"{inertia:.3g} kg m^2 on drive.output.coupling_stiffness = {stiffness:g} N m/rad"
            )
        rest = {"input_speed": 0.0, "input_torque": 0.0}
        ports = {"drive.input.port": "torque", "drive.output.port": "motion"}
        ports["drive.interpolation"] = "hold"  # `linear` is late by half a step: unstable
        self.twin = pt.Twin(scene.replace(**ports, **rest), tolerance=1e-3)
        self.ports = self.twin.port_states

    def step(self, motor_torque: float) -> pt.PortStates:
        """Simulate one step of MuJoCo.

        Args:
            motor_torque: torque on the input shaft during the step [N m].

        Returns:
            Angles, speeds and torques of both shafts at the end.
        """
        self.data.qfrc_applied[self._at] = -self.ports.output_torque
        mujoco.mj_step(self.model, self.data)
        self.ports = self.twin.step(
            self.model.opt.timestep,
            input_torque=motor_torque,
            output_speed=float(self.data.qvel[self._at]),
        )
        return self.ports


def main(path: str) -> None:
    """Hold an arm at 0.5 rad against gravity with a controller of the joint angle.

    Args:
        path: name or path of the scene.
    """
    joint = GearedJoint(arm(gravity=-9.81), "elbow", pt.load_scene(path))
    ratio = 6.0
    for n in range(2000):
        error = 0.5 - joint.data.qpos[0]
        torque = (60.0 * error - 1.0 * joint.ports.input_speed / ratio) / ratio
        ports = joint.step(float(np.clip(torque, -2.0, 2.0)))
        if n % 250 == 249:
            print(
                f"{joint.data.time:.2f} s  joint {joint.data.qpos[0]:+.4f} rad  motor "
                f"{ports.input_angle / ratio:+.4f} rad  torque {-ports.output_torque:+.3f} N m"
            )


if __name__ == "__main__":
    main(sys.argv[1])
