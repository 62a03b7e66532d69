"""Mean friction coefficient of a mesh: loss over sliding speed times normal load of all pairs.

The friction of all tooth pairs is added up over a mesh cycle, each at its place on the path of
contact with its own load, sliding speed and radii of curvature, without vibration.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from .._core import Oil, tooth_contact
from ..lubrication.ohlendorf import slip_per_position
from ..model.gearbox import Gearbox
from ..model.oil import build_oil
from ..model.pair_loads import pair_loads
from ..scene import Scene

POSITIONS = 60  # in a mesh cycle

# Radii of curvature [m], +1 or -1 of an internal mesh, speeds [rad/s], and load [N].
Motion = tuple[float, float, float, float, float, float]


class Contacts(NamedTuple):
    """The loaded tooth pairs of a mesh at every position of a mesh cycle."""

    motion: list[Motion]  # arguments of `tooth_contact`, with the load of a pair along all its face
    weight: list[float]  # factors on their friction: their parts of the loss over the power

    @property
    def loss_factor(self) -> float:
        """H_v [-] with these loads of the pairs; NaN without force.

        It is the loss over the power with a friction coefficient of 1.
        """
        parts = zip(self.motion, self.weight, strict=True)
        return sum(weight * motion[-1] for motion, weight in parts) if self.weight else math.nan


def mean_coefficient(oil: Oil, contacts: Contacts) -> float:
    """Mean friction coefficient [-] of a mesh, without rolling resistance; 0 without force.

    Args:
        oil: constants of the friction laws.
        contacts: tooth pairs of the mesh, from `contacts_of`.
    """
    mean = 0.0
    for motion, weight in zip(*contacts, strict=True):
        _, boundary, viscous, *_ = tooth_contact(oil, motion)
        mean += weight * (boundary + viscous)
    return mean / contacts.loss_factor if mean else 0.0


def oil_with(scene: Scene, traction: str) -> Oil:
    """Constants of the friction laws of `scene`, with another law of viscous friction.

    Args:
        scene: the scene.
        traction: law, as in `lubrication.traction`.
    """
    return build_oil(scene.replace(**{"lubrication.traction": traction}), scene.operating_point)


def contacts_of(scene: Scene, kind: int, force: float, frequency: float) -> Contacts:
    """Tooth pairs of a mesh with healthy teeth over a mesh cycle.

    Args:
        scene: gears and stiffness.
        kind: 0 for sun-planet meshes, 1 for planet-ring meshes.
        force: of the mesh [N], negative on the coast flanks; without force there are no pairs.
        frequency: mesh frequency [Hz].

    Returns:
        The loaded pairs.
    """
    if force == 0.0:
        return Contacts([], [])
    gearset, mesh = scene.gearset, scene.gearset.geometry.meshes[kind]
    first, second, external = mesh.first.teeth, mesh.second.teeth, -1.0 if mesh.internal else 1.0
    turn = 2.0 * math.pi * (np.arange(POSITIONS) + 0.5) / (POSITIONS * gearset.tooth_numbers.sun)
    members = ("sun", "ring", "carrier", *(f"planet_{i + 1}" for i in range(gearset.planets)))
    angles = {name: turn if name == "sun" else np.zeros(POSITIONS) for name in members}
    healthy = Gearbox(scene.replace(faults=()))
    pairs = pair_loads(healthy, kind * gearset.planets, angles, np.full(POSITIONS, force))
    loaded = pairs.load > 0.0
    position, face, load = pairs.position[loaded], pairs.face[loaded], pairs.load[loaded]
    spin = 2.0 * math.pi * frequency / first, -external * 2.0 * math.pi * frequency / second
    rho1, rho2 = mesh.curvatures_at(position)
    motion = [
        (float(r1), float(r2), external, *spin, float(line))
        for r1, r2, line in zip(rho1, rho2, load / face, strict=True)
    ]
    power = POSITIONS * abs(force) * math.cos(gearset.base_helix)
    slip = slip_per_position(first, second, mesh.internal) * np.abs(position)
    return Contacts(motion, (face * slip / power).tolist())
