"""Torsional eigenproblem: as the paper prints it, (32) to (38), and that of the twin."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.linalg import eigh

from ..dynamics.train import build_train
from ..scene import Scene

PLANETS = 3
BODIES = ("sun", "planet 1", "planet 2", "planet 3", "ring", "carrier")  # order of (34)
PRINTED_MASSES = (0.272, 0.1, 0.759, 1.5)  # sun, planet, ring, carrier [kg] of (37)
CARRIER_STIFFNESS = 8.04e8  # [N/m] of (38)
MESH_STIFFNESS = 2e8  # [N/m] Table 4


class Modes(NamedTuple):
    """Natural frequencies ascending [Hz], and shapes as columns."""

    frequencies: np.ndarray
    shapes: np.ndarray


def printed_modes(
    sun_planet_stiffness: float = MESH_STIFFNESS,
    masses: tuple[float, float, float, float] = PRINTED_MASSES,
) -> Modes:
    """Modes of (35) and (36): no coupling of the carrier, stiffness without a cosine."""
    sun, planet, ring, carrier = masses
    mass = np.diag([sun, *[planet] * PLANETS, ring, carrier])
    k_sp, k_rp = sun_planet_stiffness, MESH_STIFFNESS
    stiffness = np.diag(
        [PLANETS * k_sp, *[k_sp + k_rp] * PLANETS, PLANETS * k_rp, CARRIER_STIFFNESS]
    )
    planets = slice(1, 1 + PLANETS)
    stiffness[0, planets] = stiffness[planets, 0] = -k_sp
    stiffness[4, planets] = stiffness[planets, 4] = -k_rp
    return _modes(stiffness, mass)


def twin_modes(scene: Scene) -> Modes:
    """Modes of the twin's bodies, without motor and load, at single-pair stiffness.

    From its equations of motion at rest: a spring on the transmission error of every mesh.
    """
    train = build_train(scene)
    bodies = int(train.bodies) - int(train.machines)
    stiffness = np.zeros((len(train.mass), len(train.mass)))
    for i in range(int(train.meshes)):
        place = train.body[i]
        row = np.outer(train.sign[i], train.sign[i]) * train.stiffness[train.kind[i]]
        stiffness[np.ix_(place, place)] += row
    return _modes(stiffness[:bodies, :bodies], np.diag(train.mass[:bodies]))


def _modes(stiffness: np.ndarray, mass: np.ndarray) -> Modes:
    squares, shapes = eigh(stiffness, mass)
    # A rigid motion comes out as a rounding error of either sign.
    squares[np.abs(squares) < 1e-9 * squares.max()] = 0.0
    return Modes(np.sqrt(squares) / (2.0 * math.pi), shapes)
