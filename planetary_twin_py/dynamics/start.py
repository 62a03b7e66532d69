"""Where a run begins: the train in quasi-static equilibrium at its operating point.

Each flank carries what the mean torque puts on it, the couplings are wound up, and the torques
are trimmed for the friction of one mesh cycle, so that a run is steady from its first moment but
for the vibration that the meshes start.
"""

from __future__ import annotations

import numpy as np

from .._core import Load, Model, State, Train, initial_state
from ..scene import OperatingPoint, Scene
from .bodies import MOTOR
from .speed_loop import bandwidth, speed_loop_gains
from .static_load import mesh_force, static_torques


def build_load(scene: Scene, point: OperatingPoint, train: Train) -> Load:
    """What acts on the train at an operating point."""
    control, axes = scene.drive.speed_control, train.axes
    gains = speed_loop_gains(scene, train, bandwidth(scene))
    half, offset = scene.mesh.flanks(point.backlash, scene.gearset.pressure_angle)
    return Load(
        half_backlash=half,
        offset=offset,
        inner_squared=(half - offset) ** 2,
        release=1.0 if scene.mesh.backlash == "dead_zone" else 0.0,
        target_speed=np.array([point.input_speed, point.second_input_speed][:axes]),
        slew_rate=control.slew_rate,
        torque=point.input_torque * static_torques(scene),
        ripple=point.torque_ripple,
        ripple_order=float(control.ripple_order),
        inertia=gains.inertia,
        proportional=gains.proportional,
        trim_gain=gains.trim,
    )


def start_state(scene: Scene, model: Model) -> State:
    """The state in which a run begins, at time zero and motor angle zero."""
    speed = model.load.target_speed.copy()
    if scene.drive.speed_control.start_speed is not None:
        speed[0] = scene.drive.speed_control.start_speed
    return initial_state(model, speed, mesh_force(scene, float(model.load.torque[MOTOR])))
