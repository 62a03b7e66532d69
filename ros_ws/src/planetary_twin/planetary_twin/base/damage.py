"""Damage of a gearbox in a node: its messages, services, file and report."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from diagnostic_msgs.msg import DiagnosticStatus
from planetary_twin_msgs.srv import ReplacePart
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

from planetary_twin_py.durability.damage_state import ERROR, WARNING, DamageState

from .diagnostics import Row
from .services import answer, serve_triggers

SAVED = 60.0  # [s] between two writings of the file
KEPT = 10  # messages of a topic, for reliable subscribers that are delayed
NEWEST = QoSProfile(depth=KEPT, durability=DurabilityPolicy.TRANSIENT_LOCAL)
"""Late subscribers receive the newest message."""


def fill(message: Any, fields: Mapping[str, Any]) -> Any:
    """Set `fields` of `message`, and return it."""
    for name, value in fields.items():
        setattr(message, name, value.tolist() if isinstance(value, np.ndarray) else value)
    return message


def path_of(name: str) -> Path | None:
    """Return the path of the file `name`; None without one."""
    return Path(name).expanduser().absolute() if name else None


def serve_damage(
    node: Node, save: Callable[[], Path], replace: Callable[[str], tuple[str, ...]]
) -> None:
    """
    Create the services `~/save_damage` and `~/replace_part` of `node`.

    `save` writes the file and returns its path; `replace` returns the parts whose damage is 0 now.
    Both raise `ValueError` or `OSError` for a refusal.
    """
    serve_triggers(node, {"save_damage": lambda: str(save())})
    node.create_service(ReplacePart, "~/replace_part", partial(_replace, replace))


def _replace(
    replace: Callable[[str], tuple[str, ...]],
    request: ReplacePart.Request,
    response: ReplacePart.Response,
) -> ReplacePart.Response:
    def replaced() -> str:
        response.parts = list(replace(request.part))
        return f"damage of {', '.join(response.parts)} is 0"

    return answer(response, replaced)


def damage_row(report: str, state: DamageState, fault: str = "") -> Row:
    """
    Return the report on `state`: WARN from a damage of 0.8 on, ERROR from 1 on.

    It is an error, too, if the file cannot be written, for the reason `fault`.
    """
    values = {
        part: f"{damage:.6g}" for part, damage in zip(state.parts, state.sums, strict=True)
    } | {"hours": f"{state.hours:.6g}"}
    level = DiagnosticStatus.OK
    if state.above(WARNING):
        level = DiagnosticStatus.WARN
    if fault or state.above(ERROR):
        level = DiagnosticStatus.ERROR
    sound = f"largest: {state.worst} {state.sums.max():.3g}" if state.worst else "none yet"
    lines = [fault, *state.warnings] if fault else [*state.warnings]
    return Row(report, level, "; ".join(lines) or sound, values)
