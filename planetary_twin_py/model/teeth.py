"""The teeth of a scene as arrays: stiffness and tooth pairs of both kinds of mesh.

The scenes of a study often have the same teeth. These are kept by what shapes them: they are built
from a scene that has nothing else, so they cannot follow from anything that is not compared.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from .._core import TERMS, TOTAL
from ..gearset.separation import separation
from ..mesh.loaded_entry import Entry, entry_table
from ..mesh.overlap import FaceMean, largest_overlap, overlap_ratio
from ..mesh.stiffness import StiffnessLaw
from ..mesh.tip_relief import PairGap, relieved_table
from ..mesh.tooth_pairs import NoRoomError, PairTable, pair_table, terms_in_use
from ..scene import Scene
from ..scene.drive import Drive, Machine
from ..scene.faults import Spall
from ..scene.lubrication import Lubrication
from ..scene.mesh import MeshDamping, Runout, TransmissionError
from ..scene.operating_point import OperatingPoint
from ..scene.worn import WornFlanks
from ..units.engineering import figure
from .fault_places import fault_kinks, spalls
from .stiffness_laws import loaded_force, pair_gap, stiffness_follows_load, stiffness_laws

TEETH_KEPT = 256


class Teeth(NamedTuple):
    """Fields of the teeth of `Train`. A first length of 2 is for sun-planet and
    planet-ring meshes."""

    stiffness: np.ndarray
    stiffness_base: np.ndarray
    stiffness_gain: np.ndarray
    segments: np.ndarray
    edge: np.ndarray
    shift: np.ndarray
    centre: np.ndarray
    travel: np.ndarray
    face: np.ndarray
    face_growth: np.ndarray
    present: np.ndarray
    slots: int
    terms: int
    weight: np.ndarray


class Tables(NamedTuple):
    """Teeth, and what factors of faults are tabulated by."""

    teeth: Teeth
    pairs: tuple[PairTable, ...]
    """Of sun-planet and planet-ring meshes."""
    faces: tuple[FaceMean | None, ...]
    """Means over the face of helical teeth."""
    entries: tuple[Entry, ...]
    """Pairs that touch under load, of both kinds of mesh; none where a ramp is given."""
    shape: Scene
    """Scene with only what shapes the teeth."""


def build_teeth(scene: Scene) -> Teeth:
    """Teeth of a scene, see `build_tables`."""
    return build_tables(scene).teeth


def build_tables(scene: Scene) -> Tables:
    """Teeth of a scene, which are built once for all scenes that have the same.

    Severities of faults do not shape the tables, only the places where spalls begin and end.

    Raises:
        ValueError: there is an instant without contact of teeth (see `pair_table`), or helical
            teeth overlap too much (see `FaceMean`).
    """
    return tables_of(_shape(scene))


def stiffness_at(teeth: Teeth, kind: int, fraction: np.ndarray) -> np.ndarray:
    """Stiffness of a mesh with healthy teeth [N/m], at fractions of the mesh cycle."""
    segments = int(teeth.segments[kind])
    edge = teeth.edge[kind][: segments + 1]
    fraction = edge[0] + np.mod(fraction - edge[0], 1.0)
    segment = np.clip(np.searchsorted(edge, fraction, side="right") - 1, 0, segments - 1)
    powers = (fraction - edge[segment])[:, None] ** np.arange(TERMS)
    weight = np.sum(teeth.weight[kind][segment, TOTAL] * powers, axis=1)
    return np.asarray(teeth.stiffness_base[kind] + teeth.stiffness_gain[kind] * weight)


def _shape(scene: Scene) -> Scene:
    """A scene of only what shapes the teeth: gears, elasticity, faults, a load that they feel."""
    gearset, mesh, oil = scene.gearset, scene.mesh, scene.lubrication
    torque, planets, driven = 0.0, 1, Machine.model_construct(member="sun")
    if stiffness_follows_load(scene):
        torque, planets = scene.operating_point.input_torque, gearset.planets
        driven = Machine.model_construct(member=scene.drive.input.member)
    of_bodies = {"planet_angles": (0.0,) * planets, "held": "carrier", "planet_mass": 1.0}
    of_motion = {
        "damping": MeshDamping(),
        "backlash": "dead_zone",
        "sun_planet_error": TransmissionError(),
        "planet_ring_error": TransmissionError(),
        "runout": Runout(),
        "worn": _equally_worn(mesh.worn),
    }
    return Scene.model_construct(
        name="",
        gearset=gearset.model_copy(update=of_bodies | {"equivalent_mass": None, "inertia": None}),
        mesh=mesh.model_copy(update=of_motion),
        lubrication=Lubrication.model_construct(
            youngs_modulus=oil.youngs_modulus, poisson_ratio=oil.poisson_ratio
        ),
        drive=Drive.model_construct(input=driven, output=driven),
        operating_point=OperatingPoint.model_construct(input_torque=torque),
        faults=tuple(map(_kinked, spalls(scene.faults))),
    )


def _equally_worn(worn: WornFlanks) -> WornFlanks:
    """Wear without that of single planets, which does not shape the teeth."""
    return worn.model_copy(
        update={
            name: mesh.model_copy(update={"planets": ()}) for name, mesh in worn if mesh is not None
        }
    )


def _kinked(spall: Spall) -> Spall:
    """A spall with only what shapes the tables: its places on the path of a kind of mesh."""
    return spall.model_copy(
        update={
            "planet": 1, "tooth": 0, "flank": "drive", "stiffness_loss": 0.5, "growth": None,
            "mesh": spall.mesh if spall.gear == "planet" else "sun",
        }
    )  # fmt: skip


@lru_cache(maxsize=TEETH_KEPT)
def tables_of(scene: Scene) -> Tables:
    """Tables of a scene with only what shapes the teeth."""
    laws = stiffness_laws(scene)
    faces = [_face(scene, kind, law) for kind, law in enumerate(laws)]
    loaded = scene.mesh.entry == "loaded"
    entries = tuple(
        entry_of(scene, kind, law, pair_gap(scene, kind)) for kind, law in enumerate(laws) if loaded
    )
    tables = [_table(scene, kind, laws[kind], faces[kind], entries) for kind in (0, 1)]
    teeth = Teeth(
        stiffness=np.array([law.single for law in laws]),
        stiffness_base=np.array([law.base for law in laws]),
        stiffness_gain=np.array([law.gain for law in laws]),
        segments=np.array([table.segments for table in tables]),
        edge=np.array([table.edge for table in tables]),
        shift=np.array([table.shift for table in tables]),
        centre=np.array([table.centre for table in tables]),
        travel=np.array([table.travel for table in tables]),
        face=np.array([table.face for table in tables]),
        face_growth=np.array([table.face_growth for table in tables]),
        present=np.array([table.present.sum(axis=1) for table in tables]),
        slots=max(int(table.present.sum(axis=1).max()) for table in tables),
        terms=max(terms_in_use(table) for table in tables),
        weight=np.array([table.weight for table in tables]),
    )
    for array in teeth:
        if isinstance(array, np.ndarray):
            array.flags.writeable = False  # many trains have it
    return Tables(teeth, tuple(tables), tuple(faces), entries, scene)


def _face(scene: Scene, kind: int, law: StiffnessLaw) -> FaceMean | None:
    """Means over the face of helical teeth, None of spur teeth."""
    gearset = scene.gearset
    if gearset.helix_angle == 0.0:
        return None
    mesh = gearset.geometry.meshes[kind]
    overlap = overlap_ratio(gearset.face_width, gearset.base_helix, mesh.base_pitch)
    try:
        return FaceMean(mesh.path, scene.mesh.ramp, overlap, law, fault_kinks(scene.faults, kind))
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


def _table(
    scene: Scene, kind: int, law: StiffnessLaw, face: FaceMean | None, entries: tuple[Entry, ...]
) -> PairTable:
    """Tooth pairs of a kind of mesh, with tip relief and loaded entry at the load of the scene."""
    if face is not None:
        return face.table()
    ramp, kinks, gap = scene.mesh.ramp, fault_kinks(scene.faults, kind), pair_gap(scene, kind)
    if entries:
        return entry_table(entries[kind], (*kinks, *(gap.kinks if gap else ())))
    if gap is not None:
        return relieved_table(gap, ramp, law, loaded_force(scene), kinks)
    path = scene.gearset.geometry.meshes[kind].path
    return pair_table(path, ramp, law.strength, law.sharing, kinks)


def entry_of(scene: Scene, kind: int, law: StiffnessLaw, relief: PairGap | None) -> Entry:
    """Pairs that touch where the load of the scene closes their separation, relief and wear."""
    mesh = scene.gearset.geometry.meshes[kind]

    def gap(position: np.ndarray) -> np.ndarray:
        apart = separation(mesh, position)
        return apart if relief is None else apart + relief.at(position)

    return Entry(mesh.path, gap, law, loaded_force(scene))
