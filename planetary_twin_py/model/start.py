"""Initial state of a run: quasi-static equilibrium at the operating point.

Flanks carry the mean torque, couplings are deflected, and the torques are trimmed for the mean
friction of one mesh cycle. So the run is steady from the start, except for the vibration that the
meshes excite.
"""

from __future__ import annotations

from .._core import (
    BY_MACHINE,
    BY_MOTION,
    BY_TORQUE,
    Model,
    Operation,
    PortStates,
    State,
    Train,
    operation_at,
)
from ..scene import OperatingPoint, Scene
from .bodies import MOTOR, build_bodies
from .clock import Instant
from .library import library
from .point_laws import point_laws, record_of
from .static_load import mesh_force

UNBALANCED = 1e-3  # of the mean mesh force, above which the start is no equilibrium
LIGHTEST = 1.0  # [N] mean mesh force that counts at least

_CAUSALITIES = {
    "machine": BY_MACHINE,
    "torque": BY_TORQUE,
    "motion": BY_MOTION,
    "brake": BY_MOTION,
}


class OperationBuilder:
    """Builds what follows from an operating point of a train.

    Args:
        scene: scene of the drive.
        train: of `build_train`.
    """

    def __init__(self, scene: Scene, train: Train) -> None:
        self.laws = point_laws(scene, train, [_CAUSALITIES[port] for port in scene.drive.ports])

    def build(self, point: OperatingPoint) -> Operation:
        """Backlash, torques and speeds at an operating point.

        Given torques and speeds are those of steady running there.
        """
        operation: Operation = operation_at(self.laws, record_of(point))
        return operation


def begin_given(operation: Operation, now: Instant, shown: PortStates) -> None:
    """Let given torques and motions begin as the ports show them at `now`."""
    torque = operation.torque.copy()
    for port, value in enumerate((shown.input_torque, shown.output_torque)):
        if operation.port[port] == BY_TORQUE:
            torque[port] = value
    operation.torque, operation.speed = torque, [shown.input_speed, shown.output_speed]
    operation.since_seconds, operation.since = now


def build_operation(scene: Scene, point: OperatingPoint, train: Train) -> Operation:
    """Backlash, torques and speeds at an operating point."""
    return OperationBuilder(scene, train).build(point)


def start_state(scene: Scene, model: Model) -> tuple[State, str]:
    """State at the start of a run, at time zero and motor angle zero.

    Args:
        scene: the scene.
        model: its train at the operating point.

    Returns:
        The state; and a warning if axes that move are not in equilibrium there, else "".
    """
    speed = model.operation.target_speed.copy()
    if scene.drive.speed_control.start_speed is not None:
        speed[0] = scene.drive.speed_control.start_speed
    force = mesh_force(scene, float(model.operation.torque[MOTOR]))
    state, unbalanced, body = library(scene).initial_state(model, speed, force)
    if unbalanced <= UNBALANCED * max(abs(force), LIGHTEST):
        return state, ""
    place = build_bodies(scene).place
    name = next(name for name, number in place.items() if number == body)
    return state, (
        f"no static equilibrium is found at the start: a force of {unbalanced:.3g} N on {name} is "
        "not balanced, so the run starts with a vibration that no mesh excites; simulate with "
        "--settling, or check supports and backlash"
    )
