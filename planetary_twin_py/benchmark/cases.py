"""The cases whose speed and error are reported."""

from __future__ import annotations

from typing import Any, NamedTuple

from ..scene import Scene, load_scene
from ..units import rpm


class Case(NamedTuple):
    """A scene, and how much of it is compared with the reference."""

    name: str
    changes: dict[str, Any]
    duration: float  # [s] compared
    repeats: int  # times as long a run is timed

    def scene(self) -> Scene:
        """The scene of the paper with the changes of the case."""
        return load_scene("paper").replace(**self.changes)


CASES = (
    Case("steady 1000 rpm", {}, 0.02, 20),
    Case("steady, no friction", {"lubrication.friction": False}, 0.02, 20),
    Case("steady 3000 rpm", {"input_speed": rpm(3000)}, 0.01, 20),
    Case("stiff 100 rpm", {"input_speed": rpm(100)}, 0.05, 40),
    Case("rattle", {"input_torque": 0.3, "torque_ripple": 3.0}, 0.03, 20),
    Case("light damping 1000 rpm", {"mesh.damping.law": "viscous"}, 0.01, 20),
)
