"""Separation of a pair of teeth before and after its path of contact.

Rigid teeth touch on the line of action only. Before the path begins, the tip of the second gear is
near the flank of the first; after it ends, the tip of the first gear is near the flank of the
second. Loaded teeth close this distance by their deflection (Harris 1958; Seager 1967; Munro,
Morrish and Palmer 1999). Here it is exact for involute flanks with sharp tips: an involute through
a point P of radius R at the polar angle t begins on the base circle at t + inv(acos(r_b/R)).

The angles of each gear count from the line of its centre to the pitch point, positive in the
direction in which it turns if the first gear drives counter-clockwise.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from .working import WorkingMesh

Array = NDArray[np.float64]


def separation(mesh: WorkingMesh, position: Array) -> Array:
    """Distance of the flanks of a pair, along the line of action.

    Args:
        mesh: both gears at their centre distance.
        position: of the pair after the pitch point [base pitches], (...).

    Returns:
        Rotation of one gear until the teeth touch, times its base radius [m], (...): 0 on the path
        of contact; infinite where the tip is beyond the involute of the mating tooth.
    """
    along = mesh.base_pitch * np.asarray(position, dtype=np.float64)
    early = np.asarray(position) < -mesh.path.approach
    late = np.asarray(position) > mesh.path.recess
    gap = np.zeros(np.shape(along))
    gap[early] = _tip_of_second(mesh, along[early])
    gap[late] = _tip_of_first(mesh, along[late])
    return gap


def _starts(mesh: WorkingMesh, along: Array) -> tuple[Array, Array]:
    """Polar angles at which both involutes begin on their base circles [rad]."""
    angle, (rho1, rho2) = mesh.pressure_angle, mesh.curvatures
    sense = 1.0 if mesh.internal else -1.0  # an involute of the ring is wound as that of the planet
    first = -angle + (rho1 + along) / mesh.first.base_radius
    second = -sense * angle + (sense * rho2 + along) / mesh.second.base_radius
    return first, second


def _tip_of_second(mesh: WorkingMesh, along: Array) -> Array:
    """Gap between the tip of the second gear and the flank of the first [m]."""
    first, second = _starts(mesh, along)
    gear, sense = mesh.second, 1.0 if mesh.internal else -1.0
    angle = second - sense * _involute(gear.base_radius, np.array(gear.tip_radius))
    radius, seen = _from_other(mesh, gear.tip_radius, angle, to_first=True)
    base = mesh.first.base_radius
    return np.where(radius < base, math.inf, base * (seen - first + _involute(base, radius)))


def _tip_of_first(mesh: WorkingMesh, along: Array) -> Array:
    """Gap between the tip of the first gear and the flank of the second [m]."""
    first, second = _starts(mesh, along)
    gear, sense = mesh.first, 1.0 if mesh.internal else -1.0
    angle = first - _involute(gear.base_radius, np.array(gear.tip_radius))
    radius, seen = _from_other(mesh, gear.tip_radius, angle, to_first=False)
    base = mesh.second.base_radius
    flank = second - sense * _involute(base, radius)
    return np.where(radius < base, math.inf, base * (flank - seen))


def _from_other(
    mesh: WorkingMesh, radius: float, angle: Array, to_first: bool
) -> tuple[Array, Array]:
    """Radius [m] and polar angle [rad] of a point about the centre of the other gear."""
    x, y = radius * np.cos(angle), radius * np.sin(angle)
    if mesh.internal:  # both centres are on the same side of the pitch point
        x = x - mesh.centre_distance if to_first else x + mesh.centre_distance
    else:
        x = mesh.centre_distance - x
    return np.hypot(x, y), np.arctan2(y, x)


def _involute(base: float, radius: Array) -> Array:
    """Polar angle from the start of an involute to its point at a radius [rad]; 0 inside."""
    angle = np.arccos(np.minimum(base / radius, 1.0))
    return np.asarray(np.tan(angle) - angle)
