"""Where a run begins: the train in quasi-static equilibrium at its operating point.

Each flank carries what the mean torque puts on it, the couplings are wound up, and the torques
are trimmed for the friction of one mesh cycle, so that a run is steady from its first moment but
for the vibration that the meshes start.
"""

from __future__ import annotations

from .._core import Load, Model, State, Train, initial_state
from ..scene import OperatingPoint, Scene
from .bodies import MOTOR
from .speed_loop import bandwidth, speed_loop_gains
from .static_load import mesh_force, static_torques


class LoadBuilder:
    """Builds what acts on a train at one operating point after the other.

    Args:
        scene: whose drive it is.
        train: of `build_train`.
    """

    def __init__(self, scene: Scene, train: Train) -> None:
        control = scene.drive.speed_control
        gains = speed_loop_gains(scene, train, bandwidth(scene))
        self._mesh, self._angle = scene.mesh, scene.gearset.pressure_angle
        self._axes, self._torques = train.axes, static_torques(scene)
        self._constant = Load(
            release=1.0 if scene.mesh.backlash == "dead_zone" else 0.0,
            slew_rate=control.slew_rate,
            ripple_order=float(control.ripple_order),
            inertia=gains.inertia,
            proportional=gains.proportional,
            trim_gain=gains.trim,
        )

    def build(self, point: OperatingPoint) -> Load:
        """What acts at an operating point."""
        load = self._constant.copy()
        half, offset = self._mesh.flanks(point.backlash, self._angle)
        load.half_backlash, load.offset = half, offset
        load.inner_squared = (half - offset) ** 2
        load.target_speed = [point.input_speed, point.second_input_speed][: self._axes]
        load.torque = point.input_torque * self._torques
        load.ripple = point.torque_ripple
        return load


def build_load(scene: Scene, point: OperatingPoint, train: Train) -> Load:
    """What acts on the train at an operating point."""
    return LoadBuilder(scene, train).build(point)


def start_state(scene: Scene, model: Model) -> State:
    """The state in which a run begins, at time zero and motor angle zero."""
    speed = model.load.target_speed.copy()
    if scene.drive.speed_control.start_speed is not None:
        speed[0] = scene.drive.speed_control.start_speed
    return initial_state(model, speed, mesh_force(scene, float(model.load.torque[MOTOR])))
