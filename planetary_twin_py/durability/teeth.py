"""Damage of single teeth: which tooth of each gear has passed with each tooth pair of a mesh.

Pairs are numbered as in `model/fault_places.py`, so tooth n is the tooth n of a fault.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .._core import COAST_SIDE
from ..gearset.phasing import mesh_phases
from ..scene import Scene
from .parts import parts_of_mesh, teeth_of

Array = NDArray[np.float64]
Counts = NDArray[np.int64]
_MESH, _SIDE, _PAIR, _TIMES, _STRIDE, _DAMAGE = range(6)  # columns of `MeshSums.passed`


class OfTeeth(NamedTuple):
    """What every tooth of each part has."""

    damage: Mapping[str, Array]
    """Miner sums by name of the part, (teeth,)."""
    passages: Mapping[str, Counts]
    """Passages through meshes by name of the part, (teeth,)."""

    @classmethod
    def nothing(cls) -> OfTeeth:
        """Where teeth are not counted by themselves."""
        return cls({}, {})


class _Gears(NamedTuple):
    """Gears of the meshes, (meshes, sides, 2 gears); drive flanks first."""

    teeth: Counts
    """Number of teeth."""
    shift: Counts
    """From the number of a pair to that of its tooth."""
    flank: Counts
    """Place of tooth 0 of the flank in a row of all teeth of all parts."""
    root: Counts
    """The same of the root; after all of them if the root is not counted."""


class Teeth:
    """Gives passages of tooth pairs to the teeth.

    Args:
        scene: the gearbox, with its section `durability`.
        parts: names of its parts, see `durability.parts`.
        meshes: places of the reported meshes among their drive flanks, (meshes,).
    """

    def __init__(self, scene: Scene, parts: tuple[str, ...], meshes: Counts) -> None:
        gearset = scene.gearset
        first, second = (mesh.coast_lead for mesh in gearset.geometry.meshes)
        sun, ring = mesh_phases(gearset.tooth_numbers, gearset.planet_angles, (first, second))
        phases = [*sun, *ring]
        self._sizes = {
            part: teeth_of(part, gearset.tooth_numbers._asdict())
            for part in parts
            if "_flank_" in part or part.endswith("_root")
        }
        self._ends = np.cumsum([*self._sizes.values()])
        half = 0.5 * (gearset.teeth.planet - 1)
        # a tooth of a planet meets the ring half a turn after the sun, with its other flank
        self._turned = [round(float(s - r) + half) for s, r in zip(sun, ring, strict=True)]
        rows = [[[*self._gears(mesh, side)] for side in (0, 1)] for mesh in range(len(meshes))]
        self._table = _Gears(*np.moveaxis(np.array(rows), -1, 0))
        # Pairs by which the meshes are behind those that are integrated for them.
        leaders = [phases[meshes.tolist().index(place)] for place in meshes]
        behind = [int(leader - own) for leader, own in zip(leaders, phases, strict=True)]
        self._meshes, self._behind = meshes, np.array(behind)
        self._integrated = len(np.unique(meshes))

    def of(self, passed: Array) -> OfTeeth:
        """Damage and passages of the teeth.

        Args:
            passed: tooth pairs that have passed the meshes that are integrated, (n, 9).
        """
        numbers = passed[:, :_DAMAGE].astype(np.int64)
        places = numbers[:, _MESH] % self._integrated  # each flank may have an entry
        row, mesh = np.nonzero(places[:, None] == self._meshes)
        side = numbers[row, _SIDE]
        pair = numbers[row, _PAIR] + side * self._behind[mesh]
        gears = _Gears(*(table[mesh, (side == COAST_SIDE).astype(int)] for table in self._table))
        step, times = np.repeat([side * numbers[row, _STRIDE], numbers[row, _TIMES]], 2, axis=1)
        begin = ((side * pair)[:, None] + gears.shift).ravel()
        n, tooth, count = spread(begin, step, times, gears.teeth.ravel())
        damage = passed[row, _DAMAGE:].reshape(-1, 2, 2)  # flanks and roots of both gears
        room = int(self._ends[-1])
        totals = np.zeros((2, room))
        for at, each in ((gears.flank, damage[:, 0]), (gears.root, damage[:, 1])):
            place = at.ravel()[n] + tooth
            for total, weight in zip(totals, (count * each.ravel()[n], count), strict=True):
                total += np.bincount(place, weight, room)[:room]
        split = [np.split(total, self._ends[:-1]) for total in (totals[0], totals[1].astype(int))]
        return OfTeeth(*(dict(zip(self._sizes, each, strict=True)) for each in split))

    def _gears(self, mesh: int, side: int) -> Iterator[tuple[int, int, int, int]]:
        """A row of the table for each gear of a mesh, on one of its sides."""
        kind, k = divmod(mesh, len(self._turned))
        begins = dict(zip(self._sizes, (0, *self._ends.tolist()), strict=False))
        for n, (surface, root) in enumerate(parts_of_mesh(mesh, len(self._turned), side)):
            shift = -self._turned[k] if (kind, n) == (1, 0) else 0
            shift += n * side
            uncounted = int(self._ends[-1])
            yield self._sizes[surface], shift, begins[surface], begins.get(root, uncounted)


def spread(
    begin: Counts, step: Counts, times: Counts, teeth: Counts
) -> tuple[Counts, Counts, Counts]:
    """Teeth that pass with pairs which are repeated, tooth after tooth.

    After a round over the teeth that it meets, each of these has passed once.

    Args:
        begin: first tooth of each series of passages, (n,).
        step: from the tooth of a passage to that of the next, (n,).
        times: passages in each series, (n,).
        teeth: of the gear of each, (n,).

    Returns:
        Place of the series, tooth, and how often it passes, (m,) each.
    """
    around = teeth // np.gcd(step, teeth)
    met = np.minimum(times, around)
    series = np.repeat(np.arange(len(begin)), met)
    nth = np.arange(len(series)) - np.repeat(np.cumsum(met) - met, met)
    tooth = (begin[series] + step[series] * nth) % teeth[series]
    rounds, rest = np.divmod(times, around)
    return series, tooth, rounds[series] + (nth < rest[series])
