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
from .teeth import build_tables


def build_meshes(layout: Layout, bodies: Bodies) -> dict[str, dict[str, Any]]:
    """Fields of the groups of `Train` that describe meshes and teeth.

    Raises:
        ValueError: the teeth are impossible, see `build_tables`.
    """
    scene, groups = layout.scene, layout.groups
    gears, tables = scene.gearset.geometry, build_tables(scene)
    teeth = tables.teeth
    body, sign = _rows(layout, bodies.place)
    phases = np.array([float(phases[i]) for phases in layout.phases for i in groups.leaders])
    stiffness_factors = [scene.errors.of_planet(i).stiffness for i in groups.leaders] * 2
    return {
        "mesh": {
            "body": body,
            "sign": sign,
            "lever": 1.0 / bodies.radius[body].T,
            "copies": np.tile(groups.sizes, 2),
            "kind": np.repeat([0, 1], len(groups.leaders)),
            "phase": phases,
            "stiffness_factor": np.array(stiffness_factors),
        },
        "damping": {
            "time": steady_damping_times(layout, teeth.stiffness),
            "cycles": damping_cycles(layout),
            "lowest_frequency": scene.mesh.damping.lowest_frequency,
        },
        "geometry": {
            "coast_lead": np.array([mesh.coast_lead for mesh in gears.meshes]),
            "base_pitch": gears.meshes[0].base_pitch,
            "rolling_advance": min(mesh.rolling_advance for mesh in gears.meshes),
            "pitch_curvature": np.array([mesh.curvatures for mesh in gears.meshes]),
            "external": np.array([1.0, -1.0]),
        },
        "teeth": teeth._asdict(),
        "errors": build_form_errors(layout),
        "faults": build_faults(scene, tables, groups.leaders, phases),
    }


def _rows(layout: Layout, place: dict[str, int]) -> tuple[np.ndarray, np.ndarray]:
    """Bodies of each mesh and the factors of their x in its transmission error."""
    planets, carrier = layout.leaders, layout.scene.gearset.geometry.carrier_ratio
    sun = [[place["sun"], place[planet], place["carrier"]] for planet in planets]
    ring = [[place[planet], place["ring"], place["carrier"]] for planet in planets]
    signs = np.repeat([[1.0, 1.0, -1.0], [-1.0, 1.0, -carrier]], len(planets), axis=0)
    return np.array(sun + ring), signs
