"""Scenes: schema, packaged scenes and the operating point."""

from .friction_table import friction_table
from .load import load_scene, packaged_scenes, parse_scene
from .operating_point import TUNABLES, OperatingPoint, Tunable
from .quantity import SceneError
from .scene import Scene

__all__ = [
    "TUNABLES",
    "OperatingPoint",
    "Scene",
    "SceneError",
    "Tunable",
    "friction_table",
    "load_scene",
    "packaged_scenes",
    "parse_scene",
]
