"""How the tooth pairs of a mesh share a given force, e.g. a recorded one.

The pairs have the stiffnesses k and the missing material g of `press_faulty`, at the squeeze q at
which they carry the force F: F = sum of k (q - g) over the pairs with q > g. Damping acts on all
pairs in proportion to k, so it does not change the shares, except for a worn pair that only just
touches.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .._compile import kernel
from .._records import Record, new_record
from ..mesh.tooth_pairs import PAIRS
from ..scene import Scene
from .bodies import mesh_names
from .cycle import cycle_on_side, find_segment
from .faults import FAULTS, mark_fault
from .mesh_force import pair_stiffness
from .moment import MOMENT
from .state import COAST_SIDE, DRIVE_SIDE
from .train import build_train

Array = NDArray[np.float64]


class PairLoads(NamedTuple):
    """Tooth pairs of one mesh at n instants, both arrays (n, PAIRS)."""

    position: Array
    """Distance past the pitch point [base pitches]."""
    load: Array
    """[N], 0 where there is no pair, or where it does not touch."""


def pair_loads(scene: Scene, mesh: int, angle: Mapping[str, Array], force: Array) -> PairLoads:
    """Positions and loads of the tooth pairs of a mesh, faulty teeth included.

    Args:
        scene: gears, stiffness and faults.
        mesh: number of the mesh in the order of `Result.meshes`.
        angle: angles [rad] (n,) of "sun", "planet_1" and so on, "ring" and "carrier" since the
            start of the run, modulo a turn or not.
        force: force of the mesh [N] (n,), negative on the coast flanks.

    Returns:
        Positions [base pitches] and loads [N], (n, PAIRS) each.
    """
    train, count = build_train(scene), len(force)
    counted = np.zeros((count, FAULTS))
    for f, fault in enumerate(scene.faults):
        member = f"planet_{fault.planet}" if fault.gear == "planet" else fault.gear
        counted[:, f] = _cycles(scene, member, angle)
    found = PairLoads(np.zeros((count, PAIRS)), np.zeros((count, PAIRS)))
    place = int(mesh_names(scene).place[mesh])
    cycle = _cycles(scene, "sun", angle)
    _share(train, new_record(MOMENT), place, cycle, counted, np.asarray(force, float), *found)
    return found


def _cycles(scene: Scene, member: str, angle: Mapping[str, Array]) -> Array:
    """Mesh cycles since the start, by the teeth of a gear that have passed the carrier."""
    teeth = scene.gearset.tooth_numbers._asdict()[member.partition("_")[0]]
    forwards = 1.0 if member == "sun" else -1.0
    return forwards * teeth * (angle[member] - angle["carrier"]) / (2.0 * math.pi)


@kernel
def _share(
    train: Record,
    moment: Record,
    i: int,
    cycles: np.ndarray,
    counted: np.ndarray,
    force: np.ndarray,
    position: np.ndarray,
    load: np.ndarray,
) -> None:
    """Fill positions and loads (n, PAIRS) of mesh i; `moment` is room for its faults.

    `cycles` (n,) are those of the train, `counted` (n, FAULTS) the same by the gear of each fault.
    """
    kind = train.kind[i]
    for n in range(len(force)):
        if force[n] == 0.0:
            continue
        side = DRIVE_SIDE if force[n] > 0.0 else COAST_SIDE
        cycle = cycle_on_side(train, i, side, cycles[n], 1)
        segment = find_segment(train, kind, cycle, 1.0)
        for f in range(train.faults):
            own = cycle_on_side(train, i, side, counted[n, f], train.fault_teeth[f])
            mark_fault(train, i, side, segment, f, round(own - cycle), moment.faulty)
        for p in range(PAIRS):
            position[n, p] = cycle + train.shift[kind, segment, p]
        u = cycle - train.edge[kind, segment]
        _balance(train, moment, i, segment, u, abs(force[n]), load[n])


@kernel
def _balance(
    train: Record, moment: Record, i: int, segment: int, u: float, force: float, load: np.ndarray
) -> None:
    """Fill the loads (PAIRS,) that add up to `force`, pairs that would pull taken out in turn."""
    present = train.present[train.kind[i], segment]
    load[:present] = 1.0
    for _ in range(present):
        stiffness, squeeze = 0.0, force
        for p in range(present):
            if load[p] > 0.0:
                k, gap = pair_stiffness(train, moment, i, segment, p, u)
                stiffness += k
                squeeze += k * gap
        squeeze /= stiffness
        for p in range(present):
            if load[p] > 0.0:
                k, gap = pair_stiffness(train, moment, i, segment, p, u)
                load[p] = max(k * (squeeze - gap), 0.0)
