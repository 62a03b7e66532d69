"""Weight of the bodies of a planar gear set, on the carrier."""

from __future__ import annotations

import numpy as np

from ..model.layout import Layout
from ..model.planar_rows import CENTRAL


def weight_forces(layout: Layout, turns: np.ndarray) -> np.ndarray:
    """Force of gravity on each coordinate.

    Args:
        layout: of a scene with `supports.gravity`; without supports, weight has no effect.
        turns: turns of the first motor, (P,); a second motor is at rest.

    Returns:
        Forces [N], (P, coordinates).
    """
    scene, rows = layout.scene, layout.rows
    force, supports = np.zeros((len(turns), len(rows.coordinates))), scene.supports
    if supports is None or supports.gravity == 0.0:
        return force
    carrier = 2.0 * np.pi * float(layout.ratios["carrier"][0]) * turns
    pull = supports.gravity * np.exp(1j * (supports.gravity_direction - carrier))
    for body in CENTRAL:
        weight = getattr(supports, body).mass * pull
        force[:, rows.place(f"{body}.x")], force[:, rows.place(f"{body}.y")] = (
            weight.real,
            weight.imag,
        )
    for planet, psi in zip(layout.planets, scene.gearset.planet_angles, strict=True):
        weight = supports.planet.mass * pull * np.exp(-1j * psi)
        force[:, rows.place(f"{planet}.xi")] = weight.real
        force[:, rows.place(f"{planet}.eta")] = weight.imag
    return force
