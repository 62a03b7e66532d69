"""Damage of single teeth: which tooth of each gear has passed with each tooth pair of a mesh.

Pairs are numbered as in `model/fault_places.py`, so tooth n is the tooth n of a fault.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .._core import COAST_SIDE, DRIVE_SIDE, FLANK_DAMAGE, ROOT_DAMAGE
from ..gearset.phasing import mesh_phases
from ..scene import Scene

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


class _Gear(NamedTuple):
    """A gear of a reported mesh, and its parts on one side."""

    teeth: int
    shift: int  # from the number of the pair to that of the tooth, on this side
    parts: tuple[tuple[int, str], ...]  # column of the damage, and name


class Teeth:
    """Gives passages of tooth pairs to the teeth.

    Args:
        scene: the gearbox, with its section `durability`.
        parts: names of its parts, see `durability.parts`.
    """

    def __init__(self, scene: Scene, parts: tuple[str, ...]) -> None:
        gearset = scene.gearset
        first, second = (mesh.coast_lead for mesh in gearset.geometry.meshes)
        sun, ring = mesh_phases(gearset.tooth_numbers, gearset.planet_angles, (first, second))
        self._teeth, self._planets, self._parts = gearset.tooth_numbers, gearset.planets, parts
        self._phases, half = [*sun, *ring], 0.5 * (gearset.teeth.planet - 1)
        # a tooth of a planet meets the ring half a turn after the sun, with its other flank
        self._turned = [round(float(s - r) + half) for s, r in zip(sun, ring, strict=True)]

    def of(self, passed: Array, meshes: Counts) -> OfTeeth:
        """Damage and passages of the teeth.

        Args:
            passed: tooth pairs that have passed the meshes that are integrated, (n, 9).
            meshes: places of the reported meshes among their drive flanks, (meshes,).
        """
        sizes = {part: getattr(self._teeth, part.split("_")[0]) for part in self._of_gears()}
        damage = {part: np.zeros(size) for part, size in sizes.items()}
        passages = {part: np.zeros(size, dtype=np.int64) for part, size in sizes.items()}
        numbers = passed[:, :_DAMAGE].astype(np.int64)
        places = numbers[:, _MESH] % len(np.unique(meshes))  # each flank may have an entry
        for mesh, place in enumerate(meshes):
            leader = self._phases[int(np.argmax(meshes == place))]
            for side in (DRIVE_SIDE, COAST_SIDE):
                here = (places == place) & (numbers[:, _SIDE] == side)
                own, each = numbers[here], passed[here, _DAMAGE:]
                own[:, _PAIR] += side * int(leader - self._phases[mesh])
                for gear in self._gears(mesh, side):
                    row, tooth, count = _spread(own, side, gear)
                    for column, part in gear.parts:
                        weights = count * each[row, column]
                        damage[part] += np.bincount(tooth, weights, gear.teeth)
                        passages[part] += np.bincount(tooth, count, gear.teeth).astype(np.int64)
        return OfTeeth(damage, passages)

    def _of_gears(self) -> list[str]:
        return [part for part in self._parts if "_flank_" in part or part.endswith("_root")]

    def _gears(self, mesh: int, side: int) -> Iterator[_Gear]:
        """Both gears of a reported mesh, on one of its sides."""
        kind, k = divmod(mesh, self._planets)
        flank = "drive" if side == DRIVE_SIDE else "coast"
        planet = "sun" if (side == DRIVE_SIDE) == (kind == 0) else "ring"
        named = {
            "sun": ("sun", flank), "ring": ("ring", flank), "planet": (f"planet_{k + 1}", planet),
        }  # fmt: skip
        for n, kind_of_gear in enumerate((("sun", "planet"), ("planet", "ring"))[kind]):
            name, met = named[kind_of_gear]
            parts = [(FLANK_DAMAGE + n, f"{name}_flank_{met}"), (ROOT_DAMAGE + n, f"{name}_root")]
            shift = -self._turned[k] if (kind, n) == (1, 0) else 0
            yield _Gear(
                getattr(self._teeth, kind_of_gear),
                shift + (1 if n == 1 and side == COAST_SIDE else 0),
                tuple(part for part in parts if part[1] in self._parts),
            )


def _spread(pairs: Counts, side: int, gear: _Gear) -> tuple[Counts, Counts, Counts]:
    """Teeth of a gear that pass with tooth pairs: places of the pairs, teeth, and how often.

    The pairs of a repeated cycle pass in turn: after a round over the teeth that they meet, each of
    these has passed once.
    """
    times, stride = pairs[:, _TIMES], side * pairs[:, _STRIDE]
    round_ = gear.teeth // np.gcd(stride, gear.teeth)
    met = np.minimum(times, round_)
    row = np.repeat(np.arange(len(pairs)), met)
    nth = np.arange(len(row)) - np.repeat(np.cumsum(met) - met, met)
    tooth = (side * pairs[row, _PAIR] + gear.shift + stride[row] * nth) % gear.teeth
    rounds, rest = np.divmod(times, round_)
    return row, tooth, rounds[row] + (nth < rest[row])
