"""Reports in /diagnostics which dynamics `dynamics: auto` has selected, and why."""

from __future__ import annotations

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

from planetary_twin_py import DynamicsChoice, OperatingPoint
from planetary_twin_py.recording.ros2.topics import status_name

DYNAMICS = "simulation: dynamics"


def dynamics_status(
    choice: DynamicsChoice, point: OperatingPoint, hardware: str
) -> DiagnosticStatus:
    """
    Return the report on `choice` at the present operating `point`.

    It is a warning where the point is no longer the one at which errors were measured. `hardware`
    is the namespace of the twin, the `hardware_id` of the status.
    """
    measured = choice.scene.operating_point
    changed = [name for name, value in measured if getattr(point, name) != value]
    message = choice.text
    if changed:
        message = f"{', '.join(changed)} changed since; {message}"
    errors = {
        f"error.{each.dynamics}": each.refused or f"{each.error:.6g}" for each in choice.candidates
    }
    values = {"dynamics": choice.dynamics, "allowed_error": f"{choice.allowed:g}", **errors}
    return DiagnosticStatus(
        level=DiagnosticStatus.WARN if changed else DiagnosticStatus.OK,
        name=status_name(DYNAMICS, hardware),
        message=message,
        hardware_id=hardware,
        values=[KeyValue(key=key, value=value) for key, value in values.items()],
    )
