"""The gearset as a robot: its parts as solids, and the URDF that puts them together."""

from __future__ import annotations

from ..scene.gearset import Gearset
from .frames import Frame, frames
from .mesh_files import mesh_files
from .urdf import urdf

__all__ = ["Frame", "frames", "robot_description"]


def robot_description(gearset: Gearset, base: str = "gearbox") -> str:
    """URDF text whose root link is `base`; its meshes are files in the user's cache folder.

    Raises `OSError` where these cannot be written.
    """
    return urdf(gearset, base, {part: file.as_uri() for part, file in mesh_files(gearset).items()})
