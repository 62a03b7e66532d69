"""Mesh frequency of rigid gears at an operating point."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..gearset.kinematics import mesh_frequency
from ..scene import Scene
from .bodies import rigid_speeds

if TYPE_CHECKING:
    pass


def wanted_mesh_frequency(scene: Scene) -> float:
    """Mesh frequency of rigid gears at the speeds of the operating point [Hz].

    Args:
        scene: the scene.
    """
    point = scene.operating_point
    speeds = rigid_speeds(scene, (point.input_speed, point.second_input_speed))
    return mesh_frequency(scene.gearset.tooth_numbers, speeds["sun"], speeds["carrier"])
