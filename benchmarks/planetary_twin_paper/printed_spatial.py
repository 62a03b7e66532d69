"""Stiffness matrices of Salagianni et al. 2017, eqs. (25)-(28), as printed.

The coordinates are x, y, z, w_x, w_y and u. There are two errors. Every entry of (25) and (26) is a
product of two factors, one of its row and one of its column, but entry (1,5) has the opposite sign;
a helical mesh is therefore not a spring. The last row of (27) couples the rotation of the carrier
to y by k_zz, where (28) has k_xx; a common motion of carrier and planet is therefore resisted. With
a helix angle of zero the first error has no effect.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np


class PinStiffness(NamedTuple):
    """Stiffnesses of the pin of a planet [N/m]."""

    x: float
    """k_xx"""
    y: float
    """k_yy"""
    z: float
    """k_zz"""
    wx: float
    """Against tilting about x."""
    wy: float
    """Against tilting about y."""


def mesh_block(stiffness: float, angle: float, helix: float) -> np.ndarray:
    """Matrix K_si of (25) or K_ri of (26) [N/m], (6, 6).

    Args:
        stiffness: stiffness of the mesh [N/m].
        angle: psi_si or psi_ri [rad].
        helix: helix angle [rad].
    """
    c, s, cb, sb = math.cos(angle), math.sin(angle), math.cos(helix), math.sin(helix)
    v = np.array([cb * c, -cb * s, -sb, sb * c, -sb * s, cb])
    block = np.outer(v, v)
    block[0, 4] = block[4, 0] = cb * sb * c * s
    return stiffness * block


def coupling_block(pin: PinStiffness, psi: float, gamma: float) -> np.ndarray:
    """Matrix K_c12i of (27) [N/m], (6, 6).

    Args:
        pin: stiffnesses of the pin.
        psi: position of the planet [rad].
        gamma: r_c/r_p.
    """
    block = np.diag([-pin.y, -pin.x, -pin.z, -gamma * pin.wy, -gamma * pin.wx, 0.0])
    block[3, 2], block[4, 2] = -pin.z * math.cos(psi), pin.z * math.sin(psi)
    block[5, 0], block[5, 1] = pin.y * math.cos(psi), -pin.z * math.sin(psi)
    return block


def carrier_block(pin: PinStiffness, psi: float) -> np.ndarray:
    """Matrix K_c11i of (28) [N/m], (6, 6).

    Args:
        pin: stiffnesses of the pin.
        psi: position of the planet [rad].
    """
    c, s = math.cos(psi), math.sin(psi)
    block = np.diag(
        [
            pin.y,
            pin.x,
            pin.z,
            pin.z * c * c + pin.wy,
            pin.z * s * s + pin.wx,
            pin.x * s * s + pin.y * c * c,
        ]
    )
    upper = {
        (0, 5): -pin.y * c,
        (1, 5): pin.x * s,
        (2, 3): pin.z * c,
        (2, 4): -pin.z * s,
        (3, 4): -pin.z * c * s,
    }
    for (i, j), value in upper.items():
        block[i, j] = block[j, i] = value
    return block


def planet_block(pin: PinStiffness, gamma: float) -> np.ndarray:
    """Matrix k_22i of the text after (28) [N/m], (6, 6).

    Args:
        pin: stiffnesses of the pin.
        gamma: r_c/r_p.
    """
    return np.diag([pin.x, pin.y, pin.z, gamma**2 * pin.wy, gamma**2 * pin.wx, 0.0])
