"""Planar model of Lin and Parker 1999 (J. Vib. Acoust. 121, 316) with 3 (N + 3) coordinates.

Coordinates of sun, ring and carrier are x, y and u = r theta in the frame of the carrier. Those of
a planet are xi in the radial and eta in the tangential direction, and u. Gyroscopic terms, which
(36) of Salagianni et al. 2017 leaves out, are in `turning`.
"""

from __future__ import annotations

import numpy as np

from ..model.planar_rows import CENTRAL, DRIVE, planar_rows
from .springs import Spring, SpringModel
from .supported_set import SupportedSet


def planar_model(data: SupportedSet) -> SpringModel:
    """Spring model with the matrices of Lin and Parker 1999.

    Args:
        data: bodies and stiffnesses of the gearset.

    Returns:
        Masses and springs over 3 (N + 3) coordinates.
    """
    rows = planar_rows(data.planet_angles, data.sun_angle, data.ring_angle)
    identity = np.eye(len(rows.coordinates))
    springs = [
        Spring(
            f"{body}_{kind}",
            getattr(getattr(data, body), kind),
            identity[rows.place(f"{body}.{m}")],
        )
        for body in CENTRAL
        for kind, m in (("bearing", "x"), ("bearing", "y"), ("torsion", "u"))
    ]
    planets, (meshes, pins) = len(data.planets), data.factors
    kinds = ["sun_planet"] * planets + ["planet_ring"] * planets
    for kind, row, factor in zip(kinds, rows.flanks(DRIVE), 2 * meshes, strict=True):
        springs.append(Spring(kind, factor * getattr(data, kind), row, factor))
    for (outwards, sideways), factor in zip(rows.pin, pins, strict=True):
        for stiffness, row in ((data.planet.bearing, outwards), (data.planet.sideways, sideways)):
            springs.append(Spring("planet_bearing", factor * stiffness, row, factor))
    bodies = [data.body(name) for name in (*CENTRAL, *data.planets)]
    masses = [mass for body in bodies for mass in (body.mass, body.mass, body.rim_mass)]
    return SpringModel(rows.coordinates, np.array(masses), tuple(springs))
