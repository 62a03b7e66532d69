"""Faulty teeth: the tooth pairs that contain them, and their effect on these pairs.

Pairs are numbered in the order in which they pass the pitch point. On the drive side, pair n of a
mesh is tooth n of both gears, modulo their numbers of teeth and counted backwards on the second
gear. On the coast side the motion is mirrored and half a pitch later: pair n is tooth -n of the
first gear and tooth 1 - n of the second.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from .._core import MESHES, NOWHERE, PAIRS, SEGMENTS, TERMS
from ..mesh.overlap import FaceMean
from ..mesh.tooth_pairs import Along, PairTable, along
from ..scene import Scene
from ..scene.faults import MOST_FAULTS, SPALL_EDGE, Crack, Fault, Spall, Wear
from .stiffness_laws import crack_factor

FAULTS = MOST_FAULTS


def fault_kinks(scene: Scene, kind: int) -> tuple[float, ...]:
    """Positions on the path of contact of a kind of mesh at which a fault begins or ends."""
    spalls = [f for f in scene.faults if isinstance(f, Spall) and kind in _kinds(f)]
    ends = [(f.begin, f.end) for f in spalls]
    return tuple(
        kink for begin, end in ends for kink in (begin, begin + SPALL_EDGE, end - SPALL_EDGE, end)
    )


def fault_factors(
    scene: Scene, tables: Sequence[PairTable], faces: Sequence[FaceMean | None]
) -> np.ndarray:
    """Factors of the faults on the weights of pairs (FAULTS, 2, SEGMENTS, PAIRS, TERMS).

    `faces` have the means over the face of helical teeth.
    """
    factors = np.zeros((FAULTS, 2, SEGMENTS, PAIRS, TERMS))
    for f, fault in enumerate(scene.faults):
        for kind, (table, face) in enumerate(zip(tables, faces, strict=True)):
            if kind in _kinds(fault):
                factor = _factor(scene, fault, kind)
                factors[f, kind] = along(table, factor) if face is None else face.factors(factor)
    return factors


def build_faults(scene: Scene, planets: Sequence[int], phases: np.ndarray) -> dict[str, Any]:
    """Fields of the faults of `Train`, for the sun meshes of `planets` and then their ring meshes.

    `phases` (meshes,) [mesh cycles] of these meshes include whole cycles.
    """
    teeth = scene.gearset.tooth_numbers._asdict()
    pairs = np.full((FAULTS, MESHES, 2), NOWHERE)
    for f, fault in enumerate(scene.faults):
        for i in range(len(phases)):
            kind, n = divmod(i, len(planets))
            if kind in _kinds(fault) and (fault.gear != "planet" or fault.planet - 1 == planets[n]):
                pairs[f, i] = _pairs(scene, fault, kind, phases[n] - phases[i])
    return {
        "count": len(scene.faults),
        "teeth": np.array([teeth[fault.gear] for fault in scene.faults], dtype=int),
        "pair": pairs,
        "gap": np.array([f.depth if isinstance(f, Wear) else 0.0 for f in scene.faults]),
    }


def _kinds(fault: Fault) -> tuple[int, ...]:
    """Kinds of mesh on which a fault acts."""
    if fault.gear != "planet":
        return (0,) if fault.gear == "sun" else (1,)
    if isinstance(fault, Crack):
        return (0, 1)
    return (0,) if fault.mesh == "sun" else (1,)


def _pairs(scene: Scene, fault: Fault, kind: int, lead: float) -> tuple[int, int]:
    """Numbers of the faulty pair in a mesh, on the drive and on the coast side.

    The sun mesh of the same planet is `lead` mesh cycles later.
    """
    teeth, number = scene.gearset.tooth_numbers, fault.tooth
    if fault.gear == "planet" and kind == 1:
        # A tooth meets the ring half a turn after the sun, with its other flank.
        number += round(lead + 0.5 * teeth.planet - 0.5)
    first = fault.gear == ("sun", "planet")[kind]
    modulus = teeth._asdict()[fault.gear]
    drive, coast = number % modulus, (-number if first else 1 - number) % modulus
    if isinstance(fault, Crack):
        return drive, coast
    return (drive, NOWHERE) if fault.flank == "drive" else (NOWHERE, coast)


def _factor(scene: Scene, fault: Fault, kind: int) -> Along:
    """Factor on the stiffness of the pair over its position on the path of contact."""
    if isinstance(fault, Wear):
        return np.ones_like
    if isinstance(fault, Crack):
        return crack_factor(scene, fault, kind)
    corners = [fault.begin, fault.begin + SPALL_EDGE, fault.end - SPALL_EDGE, fault.end]
    return lambda s: 1.0 - fault.stiffness_loss * np.interp(s, corners, [0.0, 1.0, 1.0, 0.0])
