"""Natural frequencies and mode shapes of a spring model, and what kind each mode is.

Kinds (Lin and Parker 1999; Eritenel and Parker 2009 in three dimensions): "rigid"; "planet", where
sun, ring and carrier stand still; "rotational", where they turn (and move along the axis) only;
"translational", where they move across it (and tilt) only; "mixed" where planets are not alike.
"""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.linalg import eigh

from .springs import SpringModel

CENTRAL = ("sun", "ring", "carrier", "motor", "load", "second_motor")
ALONG = ("u", "z")  # motions of a central member in a rotational mode
RIGID = 1e-6  # of the highest frequency: below it a mode is rigid
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
    """Solve (K - w^2 M) phi = 0 (Salagianni et al. 2017, eq. (36))."""
    scale = 1.0 / np.sqrt(model.mass)
    squares, vectors = eigh(model.stiffness * np.outer(scale, scale))
    frequencies = np.sqrt(np.maximum(squares, 0.0)) / (2.0 * np.pi)
    frequencies[frequencies < RIGID * frequencies[-1]] = 0.0
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
