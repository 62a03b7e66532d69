"""The meshes of a scene as arrays: teeth, phases, errors of form.

Order of the meshes: sun meshes of the integrated planets, then their ring meshes. Arrays
with a first length of 2 hold the sun-planet mesh at 0 and the planet-ring mesh at 1.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..scene import Scene
from .bodies import Bodies
from .faults import build_faults
from .form_errors import build_form_errors
from .mesh_damping import damping_cycles, steady_damping_times
from .planet_groups import PlanetGroups, planet_groups, scene_phases
from .teeth import build_teeth


def build_meshes(scene: Scene, bodies: Bodies) -> dict[str, dict[str, Any]]:
    """Fields of the groups of `Train` that describe meshes and teeth.

    Raises:
        ValueError: the teeth are impossible, see `build_teeth`.
    """
    gearset, damping = scene.gearset, scene.mesh.damping
    gears, teeth = gearset.geometry, build_teeth(scene)
    groups = planet_groups(scene)
    body, sign = _rows(groups, bodies.place, gears.carrier_ratio)
    phases = np.array([float(phases[i]) for phases in scene_phases(scene) for i in groups.leaders])
    of_teeth = teeth._asdict()
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
            "time": steady_damping_times(scene, teeth.stiffness),
            "cycles": damping_cycles(scene),
            "lowest_frequency": damping.lowest_frequency,
        },
        "geometry": {
            "coast_lead": np.array([mesh.coast_lead for mesh in gears.meshes]),
            "base_pitch": gears.meshes[0].base_pitch,
            "rolling_advance": min(mesh.rolling_advance for mesh in gears.meshes),
            "pitch_curvature": np.array([mesh.curvatures for mesh in gears.meshes]),
            "external": np.array([1.0, -1.0]),
        },
        "teeth": of_teeth,
        "errors": build_form_errors(scene, groups.leaders),
        "faults": {
            "factor": of_teeth.pop("fault_factor"),
            **build_faults(scene, groups.leaders, phases),
        },
    }


def _rows(
    groups: PlanetGroups, place: dict[str, int], carrier: float
) -> tuple[np.ndarray, np.ndarray]:
    """Bodies of each mesh and the factors of their x in its transmission error.

    `carrier` is the factor of the carrier in ring meshes, see `GearSet.carrier_ratio`.
    """
    numbers = [leader + 1 for leader in groups.leaders]
    sun = [[place["sun"], place[f"planet_{i}"], place["carrier"]] for i in numbers]
    ring = [[place[f"planet_{i}"], place["ring"], place["carrier"]] for i in numbers]
    signs = np.repeat([[1.0, 1.0, -1.0], [-1.0, 1.0, -carrier]], len(numbers), axis=0)
    return np.array(sun + ring), signs
