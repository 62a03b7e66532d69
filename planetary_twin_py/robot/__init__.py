"""The gearset as a robot: its parts as solids, and its URDF."""

from __future__ import annotations

from .frames import Frame, frame_of, frames
from .urdf import robot_description

__all__ = ["Frame", "frame_of", "frames", "robot_description"]
