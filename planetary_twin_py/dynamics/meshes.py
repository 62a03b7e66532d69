"""The meshes of a scene as arrays: tables of tooth pairs, phases, errors of form.

Order of the meshes: sun meshes of the planets that are integrated, then their ring meshes. Arrays
with a first length of 2 hold the sun-planet mesh at 0 and the planet-ring mesh at 1.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..gearset.geometry import base_pitch, pitch_radius, planet_ring_path, sun_planet_path
from ..gearset.phasing import mesh_phases
from ..mesh.tooth_pairs import pair_table, terms_in_use
from ..scene import Scene
from .alike import PlanetGroups, planet_groups
from .bodies import Bodies
from .faults import build_faults, fault_kinks
from .form_errors import build_form_errors
from .mesh_damping import damping_cycles, steady_damping_times
from .stiffness_laws import GEARS, stiffness_laws


def build_meshes(scene: Scene, bodies: Bodies) -> dict[str, Any]:
    """Fields of `Train`.

    Raises:
        ValueError: the teeth leave a moment without contact (see `pair_table`).
    """
    gearset, damping = scene.gearset, scene.mesh.damping
    teeth, angle = gearset.tooth_numbers, gearset.pressure_angle
    laws = stiffness_laws(scene)
    tables = [
        pair_table(
            path(teeth, angle, gearset.addendum),
            scene.mesh.ramp,
            laws[kind].strength,
            laws[kind].sharing,
            fault_kinks(scene, kind),
        )
        for kind, path in enumerate((sun_planet_path, planet_ring_path))
    ]
    groups = planet_groups(scene)
    body, sign = _rows(groups, bodies.place)
    phases = np.array(
        [float(phases[i]) for phases in mesh_phases(teeth, gearset.planet_angles)
         for i in groups.leaders]
    )  # fmt: skip
    curvature = {
        name: pitch_radius(z, gearset.module) * math.sin(angle)
        for name, z in teeth._asdict().items()
    }
    stiffness = np.array([law.single for law in laws])
    return {
        "meshes": len(phases),
        "body": body,
        "sign": sign,
        "copies": np.tile(groups.sizes, 2),
        "kind": np.repeat([0, 1], len(groups.leaders)),
        "phase": phases,
        "stiffness": stiffness,
        "stiffness_base": np.array([law.base for law in laws]),
        "stiffness_gain": np.array([law.gain for law in laws]),
        "damping_time": steady_damping_times(scene, stiffness),
        "damping_cycles": damping_cycles(scene),
        "lowest_frequency": damping.lowest_frequency,
        "base_pitch": base_pitch(gearset.module, angle),
        "rolling_advance": math.tan(angle) * base_pitch(gearset.module, angle),
        "pitch_curvature": np.array([[curvature[gear] for gear in pair] for pair in GEARS]),
        "external": np.array([1.0, -1.0]),
        "segments": np.array([table.segments for table in tables]),
        "edge": np.array([table.edge for table in tables]),
        "shift": np.array([table.shift for table in tables]),
        "present": np.array([table.present.sum(axis=1) for table in tables]),
        "slots": max(int(table.present.sum(axis=1).max()) for table in tables),
        "terms": max(terms_in_use(table) for table in tables),
        "weight": np.array([table.weight for table in tables]),
        **build_form_errors(scene),
        **build_faults(scene, tables, groups.leaders, phases),
    }


def _rows(groups: PlanetGroups, place: dict[str, int]) -> tuple[np.ndarray, np.ndarray]:
    """Bodies of each mesh and the signs of their x in its transmission error."""
    numbers = [leader + 1 for leader in groups.leaders]
    sun = [[place["sun"], place[f"planet_{i}"], place["carrier"]] for i in numbers]
    ring = [[place[f"planet_{i}"], place["ring"], place["carrier"]] for i in numbers]
    signs = np.repeat([[1.0, 1.0, -1.0], [-1.0, 1.0, -1.0]], len(numbers), axis=0)
    return np.array(sun + ring), signs
