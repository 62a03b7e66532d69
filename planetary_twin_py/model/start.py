"""Initial state of a run: quasi-static equilibrium at the operating point.

Flanks carry the mean torque, couplings are deflected, and the torques are trimmed for the mean
friction of one mesh cycle. So the run is steady from the start, except for the vibration that the
meshes excite.
"""

from __future__ import annotations

from .._core import BY_TORQUE, Model, Operation, PortStates, State
from .clock import Instant
from .gearbox import Gearbox
from .layout import MOTOR

UNBALANCED = 1e-3  # of the mean mesh force, above which the start is no equilibrium
LIGHTEST = 1.0  # [N] mean mesh force that counts at least


def begin_given(operation: Operation, now: Instant, shown: PortStates) -> None:
    """Let given torques and motions begin as the ports show them at `now`."""
    torque = operation.torque.copy()
    for port, value in enumerate((shown.input_torque, shown.output_torque)):
        if operation.port[port] == BY_TORQUE:
            torque[port] = value
    operation.torque, operation.speed = torque, [shown.input_speed, shown.output_speed]
    operation.since_seconds, operation.since = now


def start_state(gearbox: Gearbox, model: Model) -> tuple[State, str]:
    """State at the start of a run, at time zero and motor angle zero.

    Args:
        gearbox: of the scene.
        model: its train at the operating point.

    Returns:
        The state; and a warning if axes that move are not in equilibrium there, else "".
    """
    speed = model.operation.target_speed.copy()
    start_speed = gearbox.scene.drive.speed_control.start_speed
    if start_speed is not None:
        speed[0] = start_speed
    force = gearbox.mesh_force(float(model.operation.torque[MOTOR]))
    start = gearbox.core.initial_state(model, speed, force)
    if start.unbalanced <= UNBALANCED * max(abs(force), LIGHTEST):
        return start.state, ""
    name = gearbox.bodies.names[start.body]
    return start.state, (
        f"no static equilibrium is found at the start: a force of {start.unbalanced:.3g} N on "
        f"{name} is not balanced, so the run starts with a vibration that no mesh excites; "
        "simulate with --settling, or check supports and backlash"
    )
