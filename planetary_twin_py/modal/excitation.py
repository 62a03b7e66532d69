"""Modes that the meshing excites, and modes whose mesh forces cancel by the phases of the planets.

Harmonic h of the mesh frequency pulls all meshes with equal forces, with h times their mesh phases.
With N equal and equally spaced planets it excites only rotational modes if h Zs/N is an integer,
only translational modes if h Zs mod N is 1 or N - 1, and otherwise only planet modes (Kahraman
1994, Planetary gear train dynamics; Parker 2000, J. Sound Vib. 236, 561). Here the forces are
summed with the deflections of the meshes in the mode, so any spacing and stiffness is possible.
"""

from __future__ import annotations

import math

import numpy as np

from ..model.layout import Layout
from ..scene import Scene
from ..units.catalogue import SIDES
from .springs import SpringModel

EXCITED = "excited"
SUPPRESSED = "suppressed by phasing"
NO_MESH = "deflects no mesh"

LEAST = 1e-4  # share of a sum without cancellation, and of a whole deformation


def excitation(
    scene: Scene, springs: SpringModel, shapes: np.ndarray, harmonic: int, backward: bool = False
) -> str:
    """Whether a harmonic of the mesh frequency excites modes.

    Args:
        scene: gives the mesh phases.
        springs: springs of the model of the modes.
        shapes: mass-normalised shapes of modes with the same frequency [kg^-1/2], (coordinates,
            modes); those of a turning carrier vary as exp(-i w t).
        harmonic: number of the mesh harmonic, from 1.
        backward: whether the teeth pass in the sense of the clock on the sun, seen from the
            carrier. It has an effect on the modes of a turning carrier only.

    Returns:
        `EXCITED`; `SUPPRESSED`, if the forces cancel; or `NO_MESH`.
    """
    weights = np.sqrt([spring.stiffness for spring in springs.acting])
    rows = np.array([spring.row for spring in springs.acting])
    whole = float(np.linalg.norm(weights[:, None] * (rows @ shapes)))
    work, largest = _mesh_work(scene, springs, shapes, -harmonic if backward else harmonic)
    if not largest > LEAST * whole:
        return NO_MESH
    return EXCITED if work > LEAST * largest else SUPPRESSED


def _mesh_work(
    scene: Scene, springs: SpringModel, shapes: np.ndarray, harmonic: int
) -> tuple[float, float]:
    """Largest work of the forces of a kind of mesh on a mode, and that of forces in phase with it.

    Forces vary by the same fraction of the mean stiffness in all meshes of a kind; the work is
    divided by this fraction and the root of a stiffness.
    """
    work = largest = 0.0
    for kind, phases in zip(SIDES, Layout(scene).phases, strict=True):
        meshes = [spring for spring in springs.springs if spring.kind == kind]
        turns = [float(harmonic * phase % 1) for phase in phases]
        root = math.sqrt(max(spring.stiffness for spring in meshes))
        pulls = np.array([s.stiffness / root for s in meshes]) * np.exp(
            2j * np.pi * np.array(turns)
        )
        deflections = np.array([spring.row for spring in meshes]) @ shapes
        sums = deflections.conj().T @ pulls
        work = max(work, float(np.abs(sums).max()))
        largest = max(largest, float((np.abs(deflections).T @ np.abs(pulls)).max()))
    return work, largest
