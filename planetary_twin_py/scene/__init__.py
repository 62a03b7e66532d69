"""Scenes: schema, packaged scenes and the operating point."""

from .operating_point import TUNABLES, OperatingPoint, Tunable
from .quantity import SceneError
from .scene import Scene, load_scene, packaged_scenes, parse_scene

__all__ = [
    "TUNABLES",
    "OperatingPoint",
    "Scene",
    "SceneError",
    "Tunable",
    "load_scene",
    "packaged_scenes",
    "parse_scene",
]
