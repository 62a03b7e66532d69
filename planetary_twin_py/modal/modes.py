"""Natural frequencies, mode shapes and kinds of modes of a spring model.

Kinds (Lin and Parker 1999; in three dimensions Eritenel and Parker 2009): "rigid"; "planet", in
which sun, ring and carrier are at rest; "rotational", in which these only rotate (and move along
the axis); "translational", in which they only move across the axis (and tilt); otherwise "mixed",
e.g. with unequally spaced planets.
"""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.linalg import null_space, qr, svd

from .springs import SpringModel

CENTRAL = ("sun", "ring", "carrier", "motor", "load", "second_motor")
ALONG = ("u", "z")  # motions of a central member in a rotational mode
SAME = 1e-6  # relative difference below which frequencies count as equal
AT_REST = 1e-6  # share of the kinetic energy below which bodies count as at rest


class NaturalModes(NamedTuple):
    """Natural modes in ascending order of frequency."""

    frequencies: np.ndarray
    """[Hz], ascending, (modes,)."""
    shapes: np.ndarray
    """Mode shapes in columns, mass-normalised [kg^-1/2], (coordinates, modes); complex if the
    carrier turns."""
    kinds: tuple[str, ...]
    """"rigid", "planet", "rotational", "translational" or "mixed" (Lin and Parker 1999)."""
    coordinates: tuple[str, ...]
    """Names of the rows of `shapes`, e.g. "planet_2.u" for the arc length r theta."""


def modes_of(model: SpringModel) -> NaturalModes:
    """Solve (K - w^2 M) phi = 0 (Salagianni et al. 2017, eq. (36)).

    A mode is rigid if it deforms no spring, whatever the stiffnesses are. The other frequencies
    are the singular values of B, where K = B^T B. Their rounding error is proportional to the
    highest frequency; that of eigenvalues of K would be proportional to its square.

    Args:
        model: masses [kg] (coordinates,) and springs of the gearset.

    Returns:
        Frequencies [Hz] (modes,), shapes [kg^-1/2] (coordinates, modes) and kinds of all modes.
    """
    scale, springs = 1.0 / np.sqrt(model.mass), model.acting
    rows = np.array([spring.row for spring in springs]).reshape(-1, len(scale))
    free = null_space(rows)
    rigid = free.shape[1]
    basis, _ = qr(free / scale[:, None]) if rigid else (np.eye(len(scale)), None)
    roots = np.sqrt([spring.stiffness for spring in springs])
    weighted = roots[:, None] * rows * scale
    _, speeds, shapes = svd(weighted @ basis[:, rigid:], full_matrices=False)
    vectors = np.hstack([basis[:, :rigid], basis[:, rigid:] @ shapes[::-1].T])
    frequencies = np.append(np.zeros(rigid), speeds[::-1]) / (2.0 * np.pi)
    return classified(model.coordinates, vectors, scale, frequencies)


def classified(
    coordinates: tuple[str, ...], vectors: np.ndarray, scale: np.ndarray, frequencies: np.ndarray
) -> NaturalModes:
    """Modes with their kinds.

    Args:
        coordinates: names, (coordinates,).
        vectors: shapes in coordinates of unit mass, of unit length, (coordinates, modes).
        scale: displacement over that in coordinates of unit mass [kg^-1/2], (coordinates,).
        frequencies: ascending [Hz], (modes,).
    """
    kinds: list[str] = []
    for cluster in clusters(frequencies):
        kinds += _kinds(coordinates, vectors[:, cluster], frequencies[cluster.start])
    return NaturalModes(frequencies, vectors * scale[:, None], tuple(kinds), coordinates)


def clusters(frequencies: np.ndarray) -> list[slice]:
    """Group modes with equal frequencies.

    Args:
        frequencies: ascending [Hz], (modes,).

    Returns:
        Indices of each group.
    """
    gaps = np.diff(frequencies) > SAME * np.maximum(frequencies[1:], 1e-300)
    edges = [0, *(np.flatnonzero(gaps) + 1).tolist(), len(frequencies)]
    return [slice(a, b) for a, b in pairwise(edges)]


def _kinds(coordinates: tuple[str, ...], vectors: np.ndarray, frequency: float) -> list[str]:
    """Kinds of modes with one frequency, independent of the basis chosen for them."""
    count = vectors.shape[1]
    if frequency == 0.0:
        return ["rigid"] * count
    names = [name.split(".") for name in coordinates]
    turning = _gram(vectors, [body in CENTRAL and motion in ALONG for body, motion in names])
    moving = _gram(vectors, [body in CENTRAL and motion not in ALONG for body, motion in names])
    # Number of directions in which central members move; the others are planet modes.
    moved = int(np.sum(np.linalg.eigvalsh(turning + moving) > AT_REST))
    if moved == 0:
        kind = "planet"
    elif np.trace(moving) < AT_REST:
        kind = "rotational"
    elif np.trace(turning) < AT_REST:
        kind = "translational"
    else:
        kind = "mixed"
    return ["planet"] * (count - moved) + [kind] * moved


def _gram(vectors: np.ndarray, wanted: list[bool]) -> np.ndarray:
    """Scalar products of the modes over the wanted coordinates."""
    part = vectors[np.array(wanted, dtype=bool)]
    return part.conj().T @ part
