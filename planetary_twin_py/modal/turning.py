"""Natural modes of a gear set whose carrier turns, in the frame of the carrier.

M q'' + G q' + (K - C) q = 0 with the gyroscopic matrix G and the centripetal matrix C (Lin and
Parker 1999, eq. (9)). Their C has the mass of a planet on eta; here it acts on eta - u of the
carrier, which adds the stiffness that the centrifugal load of the planets gives to their pins. So
the rigid rotation has no stiffness, as it must. A tilting body has the moments of a gyroscope,
with its absolute spin.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from scipy.linalg import eig, eigh, null_space

from .modes import NaturalModes, classified
from .springs import SpringModel

PLANES = (("x", "y"), ("xi", "eta"))
ROUNDING = 1e-9  # growth rates below it, over the largest eigenvalue, are rounding


class Turning(NamedTuple):
    """Terms of the equations in a turning frame, of n coordinates."""

    gyroscopic: np.ndarray
    """Skew matrix G [N s/m], (n, n)."""
    centripetal: np.ndarray
    """Symmetric matrix C [N/m], (n, n)."""


def turning_terms(
    model: SpringModel, carrier: float, spins: Mapping[str, float], planet_angles: Sequence[float]
) -> Turning:
    """Terms for a carrier that turns.

    Args:
        model: planar or spatial.
        carrier: speed of the carrier and of the frame [rad/s].
        spins: absolute speeds of the kinds of bodies ("sun", "planet", ...) [rad/s].
        planet_angles: positions of the planets [rad], (planets,).
    """
    size = len(model.coordinates)
    gyroscopic, centripetal = np.zeros((size, size)), np.zeros((size, size))
    place = {name: k for k, name in enumerate(model.coordinates)}
    bodies = dict.fromkeys(name.split(".")[0] for name in model.coordinates)
    for body in bodies:
        for first, second in PLANES:
            if f"{body}.{first}" in place:
                a, b = place[f"{body}.{first}"], place[f"{body}.{second}"]
                twice = 2.0 * carrier * model.mass[a]
                gyroscopic[a, b] -= twice
                gyroscopic[b, a] += twice
                for row in _centrifugal_rows(place, size, body, planet_angles, a, b):
                    centripetal += model.mass[a] * carrier**2 * np.outer(row, row)
        if f"{body}.wx" in place:
            a, b = place[f"{body}.wx"], place[f"{body}.wy"]
            spin = spins[body.split("_")[0]]
            polar = model.mass[place[f"{body}.u"]] if f"{body}.u" in place else 0.0
            diametral = model.mass[a]
            whirl = 2.0 * carrier * diametral - polar * spin
            gyroscopic[a, b] -= whirl
            gyroscopic[b, a] += whirl
            for k in (a, b):
                centripetal[k, k] += diametral * carrier**2 - polar * spin * carrier
    return Turning(gyroscopic, centripetal)


def _centrifugal_rows(
    place: Mapping[str, int], size: int, body: str, angles: Sequence[float], a: int, b: int
) -> list[np.ndarray]:
    """Rows of the two displacements on which the centrifugal force acts, (coordinates,) each."""
    identity = np.eye(size)
    if not body.startswith("planet_"):
        return [identity[a], identity[b]]
    outwards, across = identity[a], identity[b]
    if f"{body}.x" in place:
        psi = angles[int(body.removeprefix("planet_")) - 1]
        outwards = math.cos(psi) * identity[a] + math.sin(psi) * identity[b]
        across = -math.sin(psi) * identity[a] + math.cos(psi) * identity[b]
    return [outwards, across - identity[place["carrier.u"]] if "carrier.u" in place else across]


def factors(model: SpringModel, terms: Turning) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Factors of K - C = S^T D S, in coordinates of unit mass.

    Args:
        model: masses and springs.
        terms: terms of the turning frame.

    Returns:
        Rigid motions [m], (n, n - m); S [1/s] with orthogonal rows, (m, n), and the signs D, (m,).
    """
    scale = 1.0 / np.sqrt(model.mass)
    rows = np.array([spring.row for spring in model.acting]).reshape(-1, len(scale))
    largest = np.abs(terms.centripetal).max() or 1.0  # 0: bodies spin on a carrier at rest
    rigid = null_space(np.vstack([rows, terms.centripetal / largest]))
    stiffness = (model.stiffness - terms.centripetal) * np.outer(scale, scale)
    squares, vectors = eigh(stiffness)
    order = np.argsort(np.abs(squares), kind="stable")[rigid.shape[1] :]  # rigid motions have 0
    squares, vectors = squares[order], vectors[:, order]
    return rigid, np.sqrt(np.abs(squares))[:, None] * vectors.T, np.sign(squares)


def system(damping: np.ndarray, springs: np.ndarray, signs: np.ndarray) -> np.ndarray:
    """Matrix of the linear equation of velocities v and z = S y.

    Args:
        damping: gyroscopic matrix and damping, in coordinates of unit mass [1/s], (n, n).
        springs: S of `factors` [1/s], (m, n).
        signs: D of `factors`, (m,).

    Returns:
        The matrix [1/s], (n + m, n + m).
    """
    return np.block([[-damping, -springs.T * signs], [springs, np.zeros((len(springs),) * 2)]])


def turning_modes(model: SpringModel, terms: Turning) -> NaturalModes:
    """Natural modes in the turning frame.

    With K - C = S^T S in coordinates of unit mass, velocities v and z = S y obey a linear equation
    with a skew matrix, so i times that matrix is Hermitian and its eigenvalues are the frequencies
    (after Meirovitch 1974, AIAA J. 12, 1337). Above a critical speed K - C = S^T D S with negative
    signs in D; Coriolis forces can keep the motion stable nevertheless, and then all eigenvalues of
    the matrix are imaginary.

    Args:
        model: masses and springs.
        terms: terms of the turning frame.

    Returns:
        Frequencies [Hz] (modes,), complex shapes [kg^-1/2] (coordinates, modes), and kinds.

    Raises:
        ValueError: centrifugal forces exceed the stiffness, and motions grow.
    """
    scale = 1.0 / np.sqrt(model.mass)
    rigid, springs, signs = factors(model, terms)
    count, gyroscopic = rigid.shape[1], terms.gyroscopic * np.outer(scale, scale)
    matrix = system(gyroscopic, springs, signs)
    stiff = signs.min() > 0.0
    rates, states = eigh(1j * matrix) if stiff else _above_critical_speeds(matrix)
    moving = slice(len(rates) - len(springs), None)  # the positive ones
    # y' = i w y with the sign of i that belongs to exp(-i w t)
    shapes = states[: len(scale), moving] / np.linalg.norm(states[: len(scale), moving], axis=0)
    bodies, _ = np.linalg.qr(rigid / scale[:, None]) if count else (np.zeros((len(scale), 0)), None)
    frequencies = np.append(np.zeros(count), rates[moving] / (2.0 * np.pi))
    return classified(model.coordinates, np.hstack([bodies, shapes]), scale, frequencies)


def _above_critical_speeds(matrix: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rates [rad/s] and states of a stable motion, in the order of `eigh`."""
    values, states = eig(matrix)
    growing = values[np.argmax(values.real)]
    if growing.real > ROUNDING * np.abs(values).max():
        raise ValueError(
            "centrifugal forces exceed the stiffness of bearings: the motion is not stable at this "
            f"speed, it grows with {growing.real:.3g} 1/s; reduce the speed, or give bearings more "
            "stiffness (supports)"
        )
    order = np.argsort(-values.imag)
    return -values.imag[order], states[:, order]
