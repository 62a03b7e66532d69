"""The meshes of a scene as arrays: tables of tooth pairs, phases, errors of form.

Order of the meshes: sun meshes of the integrated planets, then their ring meshes. Arrays
with a first length of 2 hold the sun-planet mesh at 0 and the planet-ring mesh at 1.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..engineering_units import figure
from ..mesh.overlap import FaceMean, largest_overlap, overlap_ratio
from ..mesh.stiffness import StiffnessLaw
from ..mesh.tip_relief import relieved_table
from ..mesh.tooth_pairs import NoRoomError, PairTable, pair_table, terms_in_use
from ..scene import Scene
from .bodies import Bodies
from .faults import build_faults, fault_kinks
from .form_errors import build_form_errors
from .mesh_damping import damping_cycles, steady_damping_times
from .planet_groups import PlanetGroups, planet_groups, scene_phases
from .stiffness_laws import loaded_force, pair_gap, stiffness_laws


def build_meshes(scene: Scene, bodies: Bodies) -> dict[str, Any]:
    """Fields of `Train`.

    Raises:
        ValueError: there is an instant without contact of teeth (see `pair_table`), or helical
            teeth overlap too much (see `FaceMean`).
    """
    gearset, damping = scene.gearset, scene.mesh.damping
    gears, laws = gearset.geometry, stiffness_laws(scene)
    faces = [_face(scene, kind, law) for kind, law in enumerate(laws)]
    tables = [_table(scene, kind, laws[kind], face) for kind, face in enumerate(faces)]
    groups = planet_groups(scene)
    body, sign = _rows(groups, bodies.place, gears.carrier_ratio)
    phases = np.array([float(phases[i]) for phases in scene_phases(scene) for i in groups.leaders])
    stiffness = np.array([law.single for law in laws])
    return {
        "meshes": len(phases),
        "body": body,
        "sign": sign,
        "copies": np.tile(groups.sizes, 2),
        "kind": np.repeat([0, 1], len(groups.leaders)),
        "phase": phases,
        "coast_lead": np.array([mesh.coast_lead for mesh in gears.meshes]),
        "stiffness": stiffness,
        "stiffness_base": np.array([law.base for law in laws]),
        "stiffness_gain": np.array([law.gain for law in laws]),
        "stiffness_factor": [scene.errors.of_planet(i).stiffness for i in groups.leaders] * 2,
        "damping_time": steady_damping_times(scene, stiffness),
        "damping_cycles": damping_cycles(scene),
        "lowest_frequency": damping.lowest_frequency,
        "base_pitch": gears.meshes[0].base_pitch,
        "rolling_advance": min(mesh.rolling_advance for mesh in gears.meshes),
        "pitch_curvature": np.array([mesh.curvatures for mesh in gears.meshes]),
        "external": np.array([1.0, -1.0]),
        "segments": np.array([table.segments for table in tables]),
        "edge": np.array([table.edge for table in tables]),
        "shift": np.array([table.shift for table in tables]),
        "centre": np.array([table.centre for table in tables]),
        "travel": np.array([table.travel for table in tables]),
        "face": np.array([table.face for table in tables]),
        "face_growth": np.array([table.face_growth for table in tables]),
        "present": np.array([table.present.sum(axis=1) for table in tables]),
        "slots": max(int(table.present.sum(axis=1).max()) for table in tables),
        "terms": max(terms_in_use(table) for table in tables),
        "weight": np.array([table.weight for table in tables]),
        **build_form_errors(scene, groups.leaders),
        **build_faults(scene, tables, faces, groups.leaders, phases),
    }


def _face(scene: Scene, kind: int, law: StiffnessLaw) -> FaceMean | None:
    """Means over the face of helical teeth, None of spur teeth."""
    gearset = scene.gearset
    if gearset.helix_angle == 0.0:
        return None
    mesh = gearset.geometry.meshes[kind]
    overlap = overlap_ratio(gearset.face_width, gearset.base_helix, mesh.base_pitch)
    try:
        return FaceMean(mesh.path, scene.mesh.ramp, overlap, law, fault_kinks(scene, kind))
    except NoRoomError as error:
        raise ValueError(_too_wide(scene, error)) from None


def _too_wide(scene: Scene, error: NoRoomError) -> str:
    """Message with the largest face width for the helix of the scene."""
    gearset = scene.gearset
    widest = min(
        largest_overlap(mesh.path) / overlap_ratio(1.0, gearset.base_helix, mesh.base_pitch)
        for mesh in gearset.geometry.meshes
    )
    below = 0.999 * widest  # so that its rounding fits, too
    return (
        f"gearset.face_width = {figure(gearset.face_width, 'm')}: must be at most "
        f"{figure(below, 'm')} with gearset.helix_angle = {figure(gearset.helix_angle, 'rad')}: "
        f"{error}"
    )


def _table(scene: Scene, kind: int, law: StiffnessLaw, face: FaceMean | None) -> PairTable:
    """Tooth pairs of a kind of mesh, with tip relief at the load of the scene."""
    if face is not None:
        return face.table()
    ramp, kinks, gap = scene.mesh.ramp, fault_kinks(scene, kind), pair_gap(scene, kind)
    if gap is not None:
        return relieved_table(gap, ramp, law, loaded_force(scene), kinks)
    path = scene.gearset.geometry.meshes[kind].path
    return pair_table(path, ramp, law.strength, law.sharing, kinks)


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
