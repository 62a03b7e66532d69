"""Changes of a scene that give it other dynamics."""

from __future__ import annotations

from typing import Any

from .fault_rules import MOVING_AXES
from .faults import without_pits
from .scene import Scene

_STATIC = {"planar": "quasi_static_planar", "spatial": "quasi_static_spatial"}


def under(scene: Scene, dynamics: str) -> dict[str, Any]:
    """Changes that give a scene other dynamics, without what these lack.

    Sensors are left out, as they change no motion. Only axes that move have pits in bearings and
    loads of member bearings, and faults do not grow without dynamics.

    Args:
        scene: the scene.
        dynamics: its dynamics to be.

    Returns:
        Values by name, for `Scene.replace` or a copy.
    """
    faults, durability = scene.faults, scene.durability
    if dynamics not in MOVING_AXES:
        faults = without_pits(faults)
    if dynamics.startswith("quasi_static"):
        faults = tuple(
            fault.model_copy(update={"growth": None}) if fault.growing else fault
            for fault in faults
        )
    if durability is not None and not dynamics.endswith(MOVING_AXES):
        members = dict.fromkeys(("sun", "ring", "carrier"))
        bearings = durability.bearings.model_copy(update=members)
        durability = durability.model_copy(update={"bearings": bearings})
    return {"dynamics": dynamics, "faults": faults, "sensors": (), "durability": durability}


def static_dynamics(scene: Scene) -> str:
    """Dynamics in which the axes move as in those of a scene, without vibration.

    With `dynamics: auto`, axes are held.
    """
    return scene.dynamics if scene.quasi_static else _STATIC.get(scene.dynamics, "quasi_static")
