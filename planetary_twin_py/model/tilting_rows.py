"""Rows of a mesh over axial displacements and tilts of its gears.

The normal of a pair of flanks is n = cos(beta_b) n_t + hand sin(beta_b) e_z, with n_t in the
transverse plane, e_z along the axes and the base helix angle beta_b (Kahraman 1994, J. Sound Vib.
173, 125). Forces, deflections and stiffnesses of the model are those of the transverse plane, so
the row is r = n/cos(beta_b) = n_t + hand tan(beta_b) e_z: a mesh force F along n_t has the axial
part F tan(beta_b). It acts at the pitch point in the middle of the face, at R e_r from the axis of
a gear, and turns that by R e_r x r: tilts it by -hand tan(beta_b) R about e_t.

Coast flanks have the hand of the drive flanks, but the opposite normal in the plane. As their row
counts the approach negatively, axial displacements have the same factors. Tilts change the
deflection along the face by the slope (e_z x n_t) . (theta_A - theta_B).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..scene import Scene


class MeshOfKind(NamedTuple):
    """Data that determine the rows of a mesh."""

    internal: bool
    """Whether it is a planet-ring mesh."""
    pressure_angle: float
    """Working pressure angle in the transverse plane [rad]."""
    base_helix: float
    """Helix angle on the base circle, positive for a right-hand sun [rad]."""
    central_radius: float
    """Working pitch radius of sun or ring [m]."""
    planet_radius: float
    """Working pitch radius of the planet [m]."""


class LeaningRow(NamedTuple):
    """Row of a mesh, and its slope, per motion of the central gear and of the planet."""

    axial: np.ndarray
    """Factors of the axial displacements, (2,)."""
    tilt: np.ndarray
    """Factors of the tilts [m/rad]: of the central gear about x and y, of the planet about the
    radial and the tangential direction, (2, 2)."""
    slope: np.ndarray
    """Slope of the deflection along the face per tilt [-], (2, 2)."""


def leaning_row(mesh: MeshOfKind, side: float, psi: float) -> LeaningRow:
    """Row of one side of a mesh.

    Args:
        mesh: sun with planet, or planet with ring.
        side: `model.planar_rows.DRIVE` or `COAST`.
        psi: position of the planet [rad].

    Returns:
        The row beyond the plane.
    """
    outwards = np.array([[math.cos(psi), math.sin(psi)], [1.0, 0.0]])  # for each gear
    across = np.array([[-math.sin(psi), math.cos(psi)], [0.0, 1.0]])
    lean = -1.0 if mesh.internal else 1.0
    along = lean * math.tan(mesh.base_helix)
    place = np.array([mesh.central_radius, -lean * mesh.planet_radius])
    sense = np.array([1.0, -1.0])  # the approach counts from the central gear to the planet
    cosine, sine = math.cos(mesh.pressure_angle), math.sin(mesh.pressure_angle)
    slope = -cosine * outwards + side * lean * sine * across
    return LeaningRow(
        sense * along, (-sense * along * place)[:, None] * across, sense[:, None] * slope
    )


def row_of_scene(scene: Scene, side: float, central: str, planet: int) -> LeaningRow:
    """Row of one side of a mesh of a scene.

    Args:
        scene: gives gears and planet positions.
        side: `model.planar_rows.DRIVE` or `COAST`.
        central: "sun" or "ring".
        planet: counted from 0.

    Returns:
        The row beyond the plane.
    """
    gearset, internal = scene.gearset, central == "ring"
    mesh = gearset.geometry.meshes[int(internal)]
    radii = mesh.pitch_radii[::-1] if internal else mesh.pitch_radii
    kind = MeshOfKind(internal, mesh.pressure_angle, gearset.base_helix, *radii)
    return leaning_row(kind, side, gearset.planet_angles[planet])
