"""The meshes of a scene as arrays: teeth, phases, errors of form.

Order of the meshes: sun meshes of the integrated planets, then their ring meshes. Arrays
with a first length of 2 hold the sun-planet mesh at 0 and the planet-ring mesh at 1.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .bodies import Bodies
from .faults import build_faults
from .form_errors import build_form_errors
from .layout import Layout
from .mesh_damping import damping_cycles, steady_damping_times
from .teeth import build_teeth


def build_meshes(layout: Layout, bodies: Bodies) -> dict[str, Any]:
    """Fields of `Train`.

    Raises:
        ValueError: the teeth are impossible, see `build_teeth`.
    """
    scene, groups = layout.scene, layout.groups
    gears, teeth = scene.gearset.geometry, build_teeth(scene)
    body, sign = _rows(layout, bodies.place)
    phases = np.array([float(phases[i]) for phases in layout.phases for i in groups.leaders])
    return {
        "meshes": len(phases),
        "body": body,
        "sign": sign,
        "copies": np.tile(groups.sizes, 2),
        "kind": np.repeat([0, 1], len(groups.leaders)),
        "phase": phases,
        "coast_lead": np.array([mesh.coast_lead for mesh in gears.meshes]),
        **teeth._asdict(),
        "stiffness_factor": [scene.errors.of_planet(i).stiffness for i in groups.leaders] * 2,
        "damping_time": steady_damping_times(layout, teeth.stiffness),
        "damping_cycles": damping_cycles(layout),
        "lowest_frequency": scene.mesh.damping.lowest_frequency,
        "base_pitch": gears.meshes[0].base_pitch,
        "rolling_advance": min(mesh.rolling_advance for mesh in gears.meshes),
        "pitch_curvature": np.array([mesh.curvatures for mesh in gears.meshes]),
        "external": np.array([1.0, -1.0]),
        **build_form_errors(layout),
        **build_faults(scene, groups.leaders, phases),
    }


def _rows(layout: Layout, place: dict[str, int]) -> tuple[np.ndarray, np.ndarray]:
    """Bodies of each mesh and the factors of their x in its transmission error."""
    planets, carrier = layout.leaders, layout.scene.gearset.geometry.carrier_ratio
    sun = [[place["sun"], place[planet], place["carrier"]] for planet in planets]
    ring = [[place[planet], place["ring"], place["carrier"]] for planet in planets]
    signs = np.repeat([[1.0, 1.0, -1.0], [-1.0, 1.0, -carrier]], len(planets), axis=0)
    return np.array(sun + ring), signs
