"""Faulty teeth: their effect on the tooth pairs that contain them."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from .._core import (
    FAULT_FACTORS,
    FAULT_GAPS,
    FAULTS,
    MESHES,
    NOWHERE,
    PAIRS,
    SEGMENTS,
    TERMS,
)
from ..mesh.tooth_pairs import Along, along
from ..scene import Scene, SceneError
from ..scene.faults import MOST_FAULTS, SPALL_EDGE, Crack, Fault, Pitch, Spall, Wear
from .fault_places import faulty_pairs, kinds_of
from .pitch import material
from .stiffness_laws import crack_factor
from .teeth import Tables, tables_of

assert FAULTS == MOST_FAULTS
FACTORS_KEPT = 64


def build_faults(
    scene: Scene, tables: Tables, planets: Sequence[int], phases: np.ndarray
) -> dict[str, Any]:
    """Fields of the faults of `Train`, for the sun meshes of `planets` and then their ring meshes.

    `phases` (meshes,) [mesh cycles] of these meshes include whole cycles.

    Raises:
        SceneError: the core has no room for all faults, or a crack passes the centre line.
    """
    count, teeth = len(scene.faults), scene.gearset.tooth_numbers
    pairs = np.full((FAULTS, MESHES, 2), NOWHERE)
    moduli, each = np.ones(FAULTS, dtype=int), np.zeros(FAULTS, dtype=int)
    for f, fault in enumerate(scene.faults):
        pairs[f] = faulty_pairs(fault, teeth, planets, phases)
        each[f] = isinstance(fault, Pitch)
        if kinds_of(fault) and getattr(fault, "tooth", 0) != "all":
            moduli[f] = teeth._asdict()[getattr(fault, "gear", "sun")]
    return {
        "count": count,
        "teeth": moduli,
        "each": each,
        "pair": pairs,
        **severity_fields(scene, tables),
    }


def severity_fields(scene: Scene, tables: Tables) -> dict[str, Any]:
    """Fields of the faults of `Train` that depend on severities.

    Raises:
        SceneError: the core has no room for all faults, or a crack passes the centre line.
    """
    first_gap, first_factor = np.zeros(FAULTS, dtype=int), np.full((FAULTS, 2), NOWHERE)
    gaps, factors = list[float](), [np.zeros((0, TERMS))]
    slots = tables.teeth.slots
    for f, fault in enumerate(scene.faults):
        first_gap[f] = len(gaps)
        gaps += _gaps(scene, fault)
        for kind in kinds_of(fault):
            factor = _factor(tables.shape, fault, kind)
            if factor is not None:
                first_factor[f, kind] = sum(map(len, factors))
                segments = int(tables.teeth.segments[kind])
                factors.append(factor[:segments, :slots].reshape(-1, TERMS))
    _check_room(len(gaps), sum(map(len, factors)))
    return {
        "first_gap": first_gap,
        "gap": np.array(gaps),
        "pairs": slots,
        "first_factor": first_factor,
        "factor": np.concatenate(factors),
    }


def _check_room(gaps: int, factors: int) -> None:
    if gaps > FAULT_GAPS:
        raise SceneError(f"faults: pitch deviations of {gaps} teeth: at most {FAULT_GAPS}")
    if factors > FAULT_FACTORS:
        raise SceneError(
            f"faults: their stiffness needs {factors} polynomials: at most {FAULT_FACTORS}; give "
            "fewer cracks and spalls"
        )


def _gaps(scene: Scene, fault: Fault) -> list[float]:
    """Missing material of the faulty tooth, or of each tooth as pairs count them [m]."""
    if isinstance(fault, Pitch):
        standing = material(scene, fault)
        gaps = standing.max() - standing
        # On the coast side the numbers of pairs increase as those of teeth decrease.
        return [*(gaps if fault.flank == "drive" else np.roll(gaps[::-1], 1))]
    return [fault.depth if isinstance(fault, Wear) else 0.0]


@lru_cache(maxsize=FACTORS_KEPT)
def _factor(shape: Scene, fault: Fault, kind: int) -> np.ndarray | None:
    """Coefficients (SEGMENTS, PAIRS, TERMS) of the factor on the stiffness of pairs, None for 1."""
    if isinstance(fault, Pitch):
        return None
    tables = tables_of(shape)
    function, face = _along_path(tables.shape, fault, kind), tables.faces[kind]
    found = along(tables.pairs[kind], function) if face is None else face.factors(function)
    healthy = np.zeros((SEGMENTS, PAIRS, TERMS))
    healthy[..., 0] = tables.pairs[kind].present
    return None if np.array_equal(found, healthy) else found


def _along_path(shape: Scene, fault: Fault, kind: int) -> Along:
    """Factor on the stiffness of the pair over its position on the path of contact."""
    if isinstance(fault, Crack):
        return crack_factor(shape, fault, kind)
    if isinstance(fault, Spall):
        corners = [fault.begin, fault.begin + SPALL_EDGE, fault.end - SPALL_EDGE, fault.end]
        loss = fault.stiffness_loss
        return lambda s: 1.0 - loss * np.interp(s, corners, [0.0, 1.0, 1.0, 0.0])
    return np.ones_like
