"""Statics of the tooth pairs of a mesh: the load of a pair at any position of its path.

The laws are those of the tables of tooth pairs (`mesh.tip_relief`, `mesh.loaded_entry`), but here
they are solved at each position, so a profile that wears needs no new table.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..mesh.loaded_entry import NEIGHBOURS
from ..mesh.stiffness import StiffnessLaw
from ..mesh.tip_relief import PairGap, pair_loads_at
from ..mesh.tooth_pairs import PairTable, pair_table
from ..mesh.worn import Worn
from ..scene import Scene
from .stiffness_laws import pair_gap, stiffness_laws
from .teeth import entry_of

Array = np.ndarray


class Statics(NamedTuple):
    """A pair at n positions."""

    load: Array
    """Load of the pair [N], (n,)."""
    deflection: Array
    """Deflection of the mesh with its missing material: the static transmission error [m], (n,)."""


class PathLoads(NamedTuple):
    """Pairs of a kind of mesh of spur gears, at the load for which the scene has its teeth."""

    scene: Scene
    kind: int
    law: StiffnessLaw
    gap: PairGap
    table: PairTable | None
    """Pairs without gaps, None if pairs enter by `mesh.entry`: loaded."""

    def at(self, position: Array, force: Array | float) -> Statics:
        """Loads of pairs, and deflection of the mesh.

        Args:
            position: of a pair on its path [base pitches], (n,).
            force: of the mesh [N], above 0, one or (n,).
        """
        force = np.broadcast_to(np.asarray(force, dtype=np.float64), np.shape(position))
        if self.table is not None:
            return Statics(*pair_loads_at(self.table, self.gap, self.law, force, position))
        entry = entry_of(self.scene, self.kind, self.law, self.gap)._replace(force=force)
        loads, deflection = entry.loads(position)
        return Statics(loads[:, int(np.argmin(np.abs(NEIGHBOURS)))], deflection)

    def worn(self, position: Array, depth: Array) -> PathLoads:
        """The same pairs with another wear.

        Args:
            position: after the pitch point [base pitches], increasing, (n,).
            depth: of both flanks together [m], (n,).
        """
        return self._replace(gap=self.gap._replace(worn=Worn(position, depth)))


def path_loads(scene: Scene, kind: int) -> PathLoads:
    """Pairs of a kind of mesh.

    Args:
        scene: scene with spur gears.
        kind: 0 for sun-planet meshes, 1 for planet-ring meshes.
    """
    law, path = stiffness_laws(scene)[kind], scene.gearset.geometry.meshes[kind].path
    gap = pair_gap(scene, kind) or PairGap(path, None, None)
    table = None
    if scene.mesh.entry == "ramp":
        table = pair_table(path, scene.mesh.ramp, law.strength, law.sharing)
    return PathLoads(scene, kind, law, gap, table)
