"""Static equilibrium of unilateral springs, and of bearings with clearance or rolling elements.

The elastic energy of flanks that can only push and of bearings with radial clearance or rolling
elements is convex, so an equilibrium is a minimum of the potential energy. Newton's method with a
line search finds it (Nocedal and Wright 2006, Numerical Optimization, algorithm 3.2). The energy is
piecewise smooth; a step is exact once the set of touching flanks is that of the solution and no
bearing rolls. The energy of centrifugal forces is concave: where Newton's step does not decrease
the whole energy, it is replaced by its tangent, an upper bound (Yuille and Rangarajan 2003, Neural
Comput. 15, 915). Above a critical speed, where bearings yield to centrifugal forces, the centred
equilibrium is a saddle of the energy; there the unbalanced forces decrease instead. All positions
are solved together.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .._core import RollingBearing
from ..model.rolling_bearings import press

MOST_STEPS = 200
MOST_HALVINGS = 40
BALANCED = 1e-11  # largest residual force in equilibrium, relative to the largest force
DECREASE = 1e-4  # share of the predicted decrease of the energy that a step must reach
LOOSE = 1e-9  # stiffness added to unconstrained coordinates, relative to the largest stiffness
SMALLEST = 1e-300


class Springs(NamedTuple):
    """Springs over n coordinates, at P positions."""

    softening: np.ndarray
    """Increase of the external force per displacement, positive semidefinite [N/m], (n, n)."""
    contact: np.ndarray
    """Row of each pair of flanks, their approach per displacement, (flanks, n)."""
    contact_stiffness: np.ndarray
    """Stiffness of each pair of flanks [N/m], (P, flanks)."""
    gap: np.ndarray
    """Approach at which flanks touch [m], (P, flanks)."""
    bearing: np.ndarray
    """Rows of each bearing in two directions, (bearings, 2, n)."""
    bearing_stiffness: np.ndarray
    """Radial stiffness; of rolling bearings in the initial guess only [N/m], (bearings,)."""
    clearance: np.ndarray
    """Radial clearance [m], (bearings,)."""
    offset: np.ndarray
    """Displacement at which each bearing is centred [m], (P, bearings, 2)."""
    rolling: tuple[RollingBearing | None, ...]
    """Law of each rolling bearing, None of the others, (bearings,)."""

    @property
    def linear(self) -> bool:
        """Whether no bearing has clearance or rolling elements."""
        return not self.clearance.any() and not any(self.rolling)


class Equilibrium(NamedTuple):
    """Displacements and forces in equilibrium, at P positions."""

    displacement: np.ndarray
    """Displacements [m], (P, n)."""
    contact_force: np.ndarray
    """Force of each pair of flanks, 0 where they do not touch [N], (P, flanks)."""
    bearing_force: np.ndarray
    """Force of the first body of a bearing on the second, two directions [N], (P, bearings, 2)."""


def equilibrium(springs: Springs, force: np.ndarray, closed: np.ndarray) -> Equilibrium:
    """Find the equilibrium at each position.

    Coordinates without stiffness and force, such as a floating member in an unloaded direction,
    keep the values of the initial guess.

    Args:
        springs: springs of the structure.
        force: external force on each coordinate [N], (P, n).
        closed: whether flanks carry in the initial guess, (flanks,).

    Returns:
        The equilibrium.

    Raises:
        ValueError: the forces cannot be balanced, or no equilibrium is found.
    """
    q = _guess(springs, force, closed)
    limit = BALANCED * np.abs(force).max()
    saddle = _is_saddle(springs, q)
    for _ in range(MOST_STEPS):
        gradient = _gradient(springs, force, q)
        if np.abs(gradient).max() <= limit:
            return Equilibrium(q, _contact_forces(springs, q), _bearing_forces(springs, q))
        q = _line_search(springs, force, q, gradient, saddle)
    raise ValueError("no static equilibrium is found: bearings or meshes cannot balance the load")


def _guess(springs: Springs, force: np.ndarray, closed: np.ndarray) -> np.ndarray:
    """Displacements with bilateral flanks and without clearance."""
    stiffness = springs.contact_stiffness * closed
    rhs = force + (stiffness * springs.gap) @ springs.contact
    per_bearing = springs.bearing_stiffness[:, None, None] * springs.bearing
    rhs = rhs + np.einsum("pbd,bdn->pn", springs.offset, per_bearing)
    matrix = np.einsum("bdn,bdm->nm", per_bearing, springs.bearing)
    matrix = matrix + np.einsum("pf,fn,fm->pnm", stiffness, springs.contact, springs.contact)
    return _solve(matrix, rhs)


def _is_saddle(springs: Springs, q: np.ndarray) -> np.ndarray:
    """Whether linear bearings yield to centrifugal forces with these flanks in contact, (P,)."""
    if not springs.linear or not springs.softening.any():
        return np.zeros(len(q), dtype=bool)
    values = np.linalg.eigvalsh(_tangent(springs, q) - springs.softening)
    return np.asarray(values[:, 0] < -LOOSE * values[:, -1])


def _solve(matrix: np.ndarray, rhs: np.ndarray) -> np.ndarray:
    size = np.abs(matrix).max(axis=(1, 2))[:, None, None]
    regularised = matrix + LOOSE * size * np.eye(matrix.shape[-1])
    return np.asarray(np.linalg.solve(regularised, rhs[..., None])[..., 0])


def _contact_forces(springs: Springs, q: np.ndarray) -> np.ndarray:
    approach = q @ springs.contact.T - springs.gap
    return np.asarray(springs.contact_stiffness * np.maximum(approach, 0.0))


def _bearing_forces(springs: Springs, q: np.ndarray) -> np.ndarray:
    eccentricity = eccentricities(springs, q)
    size = np.linalg.norm(eccentricity, axis=-1)
    unit = eccentricity / np.maximum(size, SMALLEST)[..., None]
    return np.asarray(_pressed(springs, size)[1][..., None] * unit)


def _pressed(springs: Springs, size: np.ndarray) -> np.ndarray:
    """Energy, force and stiffness of bearings along their eccentricities, (3, P, bearings)."""
    pressed = np.maximum(size - springs.clearance, 0.0)
    k = springs.bearing_stiffness
    laws = np.stack([0.5 * k * pressed**2, k * pressed, k * (size > springs.clearance)])
    for b, law in enumerate(springs.rolling):
        if law is not None:
            laws[:, :, b] = press(law, springs.clearance[b], size[:, b])
    return laws


def eccentricities(springs: Springs, q: np.ndarray) -> np.ndarray:
    """Displacements in the bearings from where they are centred.

    Args:
        springs: springs of the structure.
        q: displacements [m], (P, n).

    Returns:
        The displacements in two directions [m], (P, bearings, 2).
    """
    return np.einsum("bdn,pn->pbd", springs.bearing, q) - springs.offset


def _gradient(springs: Springs, force: np.ndarray, q: np.ndarray) -> np.ndarray:
    forces = _contact_forces(springs, q) @ springs.contact - q @ springs.softening
    forces = forces + np.einsum("pbd,bdn->pn", _bearing_forces(springs, q), springs.bearing)
    return np.asarray(forces - force)


def _energy(springs: Springs, force: np.ndarray, q: np.ndarray) -> np.ndarray:
    approach = np.maximum(q @ springs.contact.T - springs.gap, 0.0)
    size = np.linalg.norm(eccentricities(springs, q), axis=-1)
    total = -0.5 * np.einsum("pn,nm,pm->p", q, springs.softening, q) - np.sum(force * q, axis=1)
    total += 0.5 * np.sum(springs.contact_stiffness * approach**2, axis=1)
    return np.asarray(total + _pressed(springs, size)[0].sum(axis=1))


def _tangent(springs: Springs, q: np.ndarray) -> np.ndarray:
    """Stiffness matrix of all contacts [N/m], (P, n, n)."""
    touching = springs.contact_stiffness * (q @ springs.contact.T > springs.gap)
    matrix = (springs.contact.T * touching[:, None, :]) @ springs.contact
    eccentricity = eccentricities(springs, q)
    size = np.linalg.norm(eccentricity, axis=-1)
    unit = eccentricity / np.maximum(size, SMALLEST)[..., None]
    _, force, along = _pressed(springs, size)
    # Across its load a bearing resists by the turn of its force.
    across = np.where(size > 0.0, force / np.maximum(size, SMALLEST), along)
    outer = unit[..., :, None] * unit[..., None, :]
    block = across[..., None, None] * np.eye(2) + (along - across)[..., None, None] * outer
    return np.asarray(
        matrix + np.einsum("pbde,bdn,bem->pnm", block, springs.bearing, springs.bearing)
    )


def _line_search(
    springs: Springs, force: np.ndarray, q: np.ndarray, gradient: np.ndarray, saddle: np.ndarray
) -> np.ndarray:
    """A Newton step at each position, shortened until the energy decreases; where it has a saddle,
    until the forces that are not balanced do."""
    tangent, before = _tangent(springs, q), _energy(springs, force, q)
    unbalanced = np.linalg.norm(gradient, axis=1)

    def is_high(step: np.ndarray, part: np.ndarray) -> np.ndarray:
        """Whether the energy decreases too little, or the step leads upwards."""
        slope = np.sum(gradient * step, axis=1)
        after = _energy(springs, force, q + part[:, None] * step)
        allowed = before + DECREASE * part * slope + 1e-15 * np.abs(before)
        high = (after > allowed) | (slope > 0.0)
        if saddle.any():
            left = np.linalg.norm(_gradient(springs, force, q + part[:, None] * step), axis=1)
            high[saddle] = (left > (1.0 - DECREASE * part) * unbalanced)[saddle]
        return np.asarray(high)

    part = np.ones(len(q))
    step = _solve(tangent - springs.softening, -gradient)
    uphill = is_high(step, part) & ~saddle
    step[uphill] = _solve(tangent[uphill], -gradient[uphill])
    for _ in range(MOST_HALVINGS):
        high = is_high(step, part)
        if not high.any():
            break
        part = np.where(high, 0.5 * part, part)
    return np.asarray(q + part[:, None] * step)
