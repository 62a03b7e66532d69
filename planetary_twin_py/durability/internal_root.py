"""Stress at the root of internal teeth, which no form factor of a rack describes.

Teeth with the outline of `tooth/fillet.py` on a rim that is held outside, in plane strain. Boundary
elements give the stress along the fillet of a tooth under a force anywhere on its flank.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ..gearset.involute import SpurGear
from ..tooth.profile import ToothProfile
from .boundary_elements import NODES, Outline, shapes

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
NEIGHBOURS = 3  # teeth on each side of the loaded one
FINE, COARSE = (2, 12, 16, 3), (1, 4, 4, 1)  # elements on land, fillet, flank, half of the tip
OUTER, SIDE = 20, 6  # elements on the held edge of the rim, and on each of its cuts
SHORTEST = 1e-3  # [modules]: length of a land that is left out
DIGITS = 9  # of a stress: later ones depend on the library of linear algebra


def internal_root_stress(gear: SpurGear, rim: float, poisson: float, radius: Array) -> Array:
    """Largest tension along the fillet of an internal tooth over the normal force per width.

    Args:
        gear: an internal spur gear.
        rim: radius at which the rim is held, over the root radius.
        poisson: Poisson's ratio.
        radius: at which the force acts on the flank [m], (n,).

    Returns:
        Stress over force per width [1/m], (n,).
    """
    places, stress = _influence(gear, rim, poisson)
    points = [np.interp(radius, places, each) for each in stress.T]
    largest = np.max(points, axis=0)
    unit = 10.0 ** (np.ceil(np.log10(largest)) - DIGITS)
    return np.asarray(np.round(largest / unit) * unit)


@lru_cache(maxsize=4)
def _influence(gear: SpurGear, rim: float, poisson: float) -> tuple[Array, Array]:
    """Radii of loads [m], ascending (loads,), and stress of each at points of the fillet [1/m]."""
    land, fillet, flank, _ = _elements(gear, FINE)
    before = NEIGHBOURS * 2 * sum(_elements(gear, COARSE))
    first = OUTER + SIDE + before  # element of the loaded half of the tooth
    nodes = _outline(gear, rim)
    held = np.arange(len(nodes) // 2) < OUTER
    body = Outline(nodes, held, poisson)
    loaded = first + land + fillet + np.arange(flank)
    corner = nodes[body.elements[loaded]]
    along = corner @ shapes(NODES)[1].T
    length = (np.abs(along) @ np.array([1.0, 4.0, 1.0])) / 3.0  # Simpson's rule
    traction = np.zeros((flank, len(held), 3), dtype=complex)
    traction[np.arange(flank), loaded] = 1j * along / np.abs(along) / length[:, None]
    stress = body.stress(body.displacements(traction))[:, first : first + land + fillet]
    order = np.argsort(np.abs(corner[:, 1]))
    return np.abs(corner[order, 1]), stress[order].reshape(flank, -1)


def _outline(gear: SpurGear, rim: float) -> Complex:
    """Nodes of the loaded tooth, its neighbours and the rim, counter-clockwise, (2 m,)."""
    pitch, root = 2.0 * math.pi / gear.teeth, gear.root_radius
    end = (NEIGHBOURS + 0.5) * pitch
    parts = [rim * root * np.exp(1j * np.linspace(-end, end, 2 * OUTER + 1))]
    side = np.linspace(rim * root, root, 2 * SIDE + 1)
    parts.append(side * np.exp(1j * end))
    for k in range(NEIGHBOURS, -NEIGHBOURS - 1, -1):
        half = _half_tooth(gear, COARSE if k else FINE)
        parts += [half * np.exp(1j * k * pitch), np.conj(half[::-1]) * np.exp(1j * k * pitch)]
    parts.append(side[::-1] * np.exp(-1j * end))
    return np.concatenate([part[:-1] for part in parts])


def _elements(gear: SpurGear, wanted: tuple[int, ...]) -> tuple[int, ...]:
    """Numbers of elements on the parts of half a tooth; none on the land if one arc fills a gap."""
    land = (math.pi / gear.teeth - ToothProfile(gear).root_half_angle) * gear.root_radius
    return wanted if land > SHORTEST * gear.module else (0, *wanted[1:])


def _half_tooth(gear: SpurGear, wanted: tuple[int, ...]) -> Complex:
    """Nodes from the middle of a gap to the middle of the next tip, (2 elements + 1,)."""
    profile, elements = ToothProfile(gear), _elements(gear, wanted)
    land, fillet, flank, tip = (np.linspace(0.0, 1.0, 2 * n + 1) for n in elements)
    radius, half = profile.fillet(fillet)
    radii = profile.flank_start + flank * (gear.tip_radius - profile.flank_start)
    flanks = radii * np.exp(1j * gear.half_thickness(radii))
    middle = math.pi / gear.teeth
    parts = [
        gear.root_radius * np.exp(1j * (middle + land * (profile.root_half_angle - middle))),
        radius * np.exp(1j * half),
        flanks,
        gear.tip_radius * np.exp(1j * np.angle(flanks[-1]) * (1.0 - tip)),
    ]
    return np.concatenate([*(part[:-1] for part in parts), parts[-1][-1:]])
