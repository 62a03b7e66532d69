"""The stiffness blocks of Salagianni et al. 2017, eqs. (25)-(28), entry by entry as printed.

Coordinates x, y, z, w_x, w_y, u. What is wrong: entry (1,5) of (25) and (26) has the other sign
than the product of its row and column that all other entries are, so a helical mesh is no spring;
the last row of (27) couples the turning carrier to y by k_zz where (28) has k_xx, so moving carrier
and planet together is resisted. With a helix of zero the first does not show.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np


class PinStiffness(NamedTuple):
    """k_xx, k_yy, k_zz and the two tilting stiffnesses of a planet's pin [N/m]."""

    x: float
    y: float
    z: float
    wx: float
    wy: float


def mesh_block(stiffness: float, angle: float, helix: float) -> np.ndarray:
    """K_si of (25) or K_ri of (26) [N/m], (6, 6); `angle` is psi_si or psi_ri [rad]."""
    c, s, cb, sb = math.cos(angle), math.sin(angle), math.cos(helix), math.sin(helix)
    v = np.array([cb * c, -cb * s, -sb, sb * c, -sb * s, cb])
    block = np.outer(v, v)
    block[0, 4] = block[4, 0] = cb * sb * c * s
    return stiffness * block


def coupling_block(pin: PinStiffness, psi: float, gamma: float) -> np.ndarray:
    """K_c12i of (27) [N/m], (6, 6); gamma = r_c/r_p."""
    block = np.diag([-pin.y, -pin.x, -pin.z, -gamma * pin.wy, -gamma * pin.wx, 0.0])
    block[3, 2], block[4, 2] = -pin.z * math.cos(psi), pin.z * math.sin(psi)
    block[5, 0], block[5, 1] = pin.y * math.cos(psi), -pin.z * math.sin(psi)
    return block


def carrier_block(pin: PinStiffness, psi: float) -> np.ndarray:
    """K_c11i of (28) [N/m], (6, 6)."""
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
    """k_22i [N/m], (6, 6), as the text after (28) gives it."""
    return np.diag([pin.x, pin.y, pin.z, gamma**2 * pin.wy, gamma**2 * pin.wx, 0.0])
