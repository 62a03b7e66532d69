"""Weight of the bodies of a planar gear set, on the carrier."""

from __future__ import annotations

import numpy as np

from ..model.bodies import rigid_ratios
from ..model.planar_rows import CENTRAL, PlanarRows
from ..scene import Scene


def weight_forces(scene: Scene, rows: PlanarRows, turns: np.ndarray) -> np.ndarray:
    """Force of gravity on each coordinate.

    Args:
        scene: scene with `supports.gravity`; without supports, weight has no effect.
        rows: rows of its gear set.
        turns: turns of the first motor, (P,); a second motor is at rest.

    Returns:
        Forces [N], (P, coordinates).
    """
    force, supports = np.zeros((len(turns), len(rows.coordinates))), scene.supports
    if supports is None or supports.gravity == 0.0:
        return force
    carrier = 2.0 * np.pi * float(rigid_ratios(scene)["carrier"][0]) * turns
    pull = supports.gravity * np.exp(1j * (supports.gravity_direction - carrier))
    for body in CENTRAL:
        weight = getattr(supports, body).mass * pull
        force[:, rows.place(f"{body}.x")], force[:, rows.place(f"{body}.y")] = (
            weight.real,
            weight.imag,
        )
    for i, psi in enumerate(scene.gearset.planet_angles):
        weight = supports.planet.mass * pull * np.exp(-1j * psi)
        planet = f"planet_{i + 1}"
        force[:, rows.place(f"{planet}.xi")] = weight.real
        force[:, rows.place(f"{planet}.eta")] = weight.imag
    return force
