"""Natural frequencies and mode shapes of a spring model, and what kind each mode is.

Kinds (Lin and Parker 1999; Eritenel and Parker 2009 in three dimensions): "rigid"; "planet", where
sun, ring and carrier stand still; "rotational", where they turn (and move along the axis) only;
"translational", where they move across it (and tilt) only; "mixed" where planets are not alike.
"""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.linalg import null_space, qr, svd

from .springs import SpringModel

CENTRAL = ("sun", "ring", "carrier", "motor", "load", "second_motor")
ALONG = ("u", "z")  # motions of a central member in a rotational mode
SAME = 1e-6  # relative difference below which frequencies are one
STILL = 1e-6  # share of the kinetic energy that counts as rest


class NaturalModes(NamedTuple):
    """Modes in the order of their frequencies."""

    frequencies: np.ndarray
    """[Hz], ascending, shape (modes,)."""
    shapes: np.ndarray
    """Column m is mode m, mass-normalised [kg^-1/2], shape (coordinates, modes)."""
    kinds: tuple[str, ...]
    coordinates: tuple[str, ...]
    """Names of the rows of `shapes`."""


def modes_of(model: SpringModel) -> NaturalModes:
    """Solve (K - w^2 M) phi = 0 (Salagianni et al. 2017, eq. (36)).

    A mode is rigid if it stretches no spring, whatever the stiffnesses are. The other frequencies
    are the singular values of B, where K = B^T B: their rounding error is relative to the highest
    frequency, that of the eigenvalues of K to its square.

    Args:
        model: masses [kg] (coordinates,) and springs of the gearset.

    Returns:
        Frequencies [Hz] (modes,), shapes (coordinates, modes) and kinds of all modes.
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
    kinds: list[str] = []
    for cluster in clusters(frequencies):
        kinds += _kinds(model.coordinates, vectors[:, cluster], frequencies[cluster.start])
    return NaturalModes(frequencies, vectors * scale[:, None], tuple(kinds), model.coordinates)


def clusters(frequencies: np.ndarray) -> list[slice]:
    """Stretches of modes that share one frequency."""
    gaps = np.diff(frequencies) > SAME * np.maximum(frequencies[1:], 1e-300)
    edges = [0, *(np.flatnonzero(gaps) + 1).tolist(), len(frequencies)]
    return [slice(a, b) for a, b in pairwise(edges)]


def _kinds(coordinates: tuple[str, ...], vectors: np.ndarray, frequency: float) -> list[str]:
    """Kinds of modes of one frequency; any basis of them is as good as another."""
    count = vectors.shape[1]
    if frequency == 0.0:
        return ["rigid"] * count
    names = [name.split(".") for name in coordinates]
    turning = _gram(vectors, [body in CENTRAL and motion in ALONG for body, motion in names])
    moving = _gram(vectors, [body in CENTRAL and motion not in ALONG for body, motion in names])
    # Directions in which the central members move at all; the others are planet modes.
    moved = int(np.sum(np.linalg.eigvalsh(turning + moving) > STILL))
    if moved == 0:
        kind = "planet"
    elif np.trace(moving) < STILL:
        kind = "rotational"
    elif np.trace(turning) < STILL:
        kind = "translational"
    else:
        kind = "mixed"
    return ["planet"] * (count - moved) + [kind] * moved


def _gram(vectors: np.ndarray, wanted: list[bool]) -> np.ndarray:
    """Products of the modes with one another over the wanted coordinates."""
    part = vectors[np.array(wanted, dtype=bool)]
    return part.T @ part
