"""Loads of the tooth pairs of a mesh under a given, for example recorded, force.

The pairs have stiffnesses k and gaps g (missing material) as in a mesh with faults. They carry
the force F at the deflection q: F = sum of k (q - g) over the pairs with q > g. Damping acts on all
pairs in proportion to k, so it does not change the shares, except for a worn pair that barely
touches.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .._core import PAIRS, StepConstants, Train, share_force
from ..scene.faults import Bearing, Pin, without_pits
from ..scene.severities import with_severities
from .faults import severity_fields
from .gearbox import Gearbox
from .teeth import build_tables

Array = NDArray[np.float64]


class PairLoads(NamedTuple):
    """Tooth pairs of one mesh at n instants, all arrays (n, PAIRS).

    Of helical teeth, the part of a pair before the pitch point and that after it are pairs of their
    own: see `mesh.overlap`.
    """

    position: Array
    """Distance of the middle of the line of contact past the pitch point [base pitches]."""
    ahead: Array
    """`position` less that of the middle of the face [base pitches]; 0 for spur teeth on their
    path."""
    face: Array
    """Length of the line of contact along the axis, as a part of the face width."""
    load: Array
    """[N], 0 if there is no pair or if it does not touch."""


def train_with(gearbox: Gearbox, severities: Mapping[str, float]) -> Train:
    """Train with held axes and other severities of the faults.

    Args:
        gearbox: of the scene.
        severities: by dotted name.

    Returns:
        A train for `pair_loads`.
    """
    held = gearbox.held
    faults = without_pits(with_severities(gearbox.scene.faults, severities))
    train, scene = held.train.copy(), held.scene.model_copy(update={"faults": faults})
    for name, value in severity_fields(scene, build_tables(held.scene)).items():
        setattr(train.faults, name, value)
    return train


def pair_loads(
    gearbox: Gearbox,
    mesh: int,
    angle: Mapping[str, Array],
    force: Array,
    train: Train | None = None,
) -> PairLoads:
    """Positions and loads of the tooth pairs of a mesh, faulty teeth included.

    Args:
        gearbox: gears, stiffness and faults.
        mesh: number of the mesh in the order of `Result.meshes`.
        angle: angles [rad] (n,) of "sun", "planet_1" and so on, "ring" and "carrier" since the
            start of the run, modulo a turn or not.
        force: force of the mesh [N] (n,), negative on the coast flanks.
        train: see `train_with`; None: the severities are those of the scene.

    Returns:
        The contacts of the pairs.
    """
    held, count = gearbox.held, len(force)
    counted = np.zeros((count, len(held.scene.faults)))
    for f, fault in enumerate(held.scene.faults):
        if isinstance(fault, Pin | Bearing) or fault.planet == "all":
            continue  # all teeth have it
        member = f"planet_{fault.planet}" if fault.gear == "planet" else fault.gear
        counted[:, f] = cycles_of(held, member, angle)
    found = PairLoads(*(np.zeros((count, PAIRS)) for _ in PairLoads._fields))
    place = int(held.mesh_names.place[mesh])
    cycle = cycles_of(held, "sun", angle)
    present, forces = held.train if train is None else train, np.asarray(force, float)
    share_force(present, StepConstants(), place, cycle, counted, forces, *found)
    return found


def cycles_of(gearbox: Gearbox, member: str, angle: Mapping[str, Array]) -> Array:
    """Mesh cycles since the start, from the angle of a gear relative to the carrier.

    Args:
        gearbox: of the scene.
        member: "sun", "ring" or that of a planet, "planet_1".
        angle: see `pair_loads`.

    Returns:
        The cycles (n,).
    """
    teeth = gearbox.scene.gearset.tooth_numbers._asdict()[member.partition("_")[0]]
    forwards = 1.0 if member == "sun" else -1.0
    return forwards * teeth * (angle[member] - angle["carrier"]) / (2.0 * math.pi)
