"""Damage of the parts of a gearbox, from the sums of its meshes in the core."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from .._core import (
    BEARING_DAMAGE,
    CONTACT_STRESS,
    FLANK_DAMAGE,
    HOTTEST,
    MEMBER_DAMAGE,
    OF_SIDE,
    PASSAGE,
    ROOT_DAMAGE,
    ROOT_STRESS,
    ROUGHEST,
    SHAFT_DAMAGE,
    MeshSums,
)
from ..scene import Scene
from .damage import Damage
from .parts import MEMBERS, SHAFTS, part_names, parts_of_mesh, teeth_of
from .teeth import OfTeeth, Teeth


class Account:
    """Adds up damage of meshes to that of parts.

    Args:
        scene: the gearbox, with its section `durability`.
        meshes: places in the sums of the meshes that are reported.
    """

    def __init__(self, scene: Scene, meshes: NDArray[np.int64]) -> None:
        self.parts = part_names(scene)
        # where each flank has an entry, both are the same
        self._meshes = meshes % len(np.unique(meshes))
        assert scene.durability is not None
        teeth = scene.gearset.tooth_numbers._asdict()
        self._each = Teeth(scene, self.parts, self._meshes) if scene.durability.teeth else None
        self._no_teeth = OfTeeth.nothing()
        self._teeth = np.array([teeth_of(part, teeth) for part in self.parts])
        terms = [
            ((2 * side + counts) * len(self.parts) + self.parts.index(part), row, place)
            for part, side, counts, row, place in self._terms()
            if part in self.parts
        ]
        self._sum, *of_damage = np.array(terms).T
        self._terms_at = tuple(of_damage)
        peaks = self._peaks()
        self._extremes = tuple(np.concatenate(peaks).T)
        self._firsts = np.cumsum([0, *map(len, peaks[:-1])])
        # where the ratio is prescribed, there is no film behind it
        self._film = np.nan if scene.lubrication.lambda_ratio == "prescribed" else 1.0

    def damage(self, sums: MeshSums, duration: float) -> Damage:
        """Damage of a time.

        Args:
            sums: of the meshes over it.
            duration: its length [s].

        Returns:
            The damage of each part.
        """
        parts, meshes = len(self.parts), len(self._meshes)
        totals = np.bincount(self._sum, sums.damage[self._terms_at], 4 * parts)
        counted = totals[: 2 * parts] + totals[2 * parts :]  # damage, then passages
        peaks = np.maximum.reduceat(sums.extreme[self._extremes], self._firsts)
        peaks[peaks <= 0.0] = np.nan  # 0 stands for no value
        return Damage(
            duration, self.parts, counted[:parts] / self._teeth, counted[parts:].astype(np.int64),
            self._teeth, {
                "contact_stress": np.sqrt(peaks[:meshes]),
                "root_stress": peaks[meshes : -2 * meshes],
                "contact_temperature": peaks[-2 * meshes : -meshes],
                "specific_film": self._film / peaks[-meshes:],
            },
            self._no_teeth if self._each is None else self._each.of(sums.passed()),
        )  # fmt: skip

    def _terms(self) -> Iterator[tuple[str, int, bool, int, int]]:
        """Part, side, whether it counts passages, row and place of each term of the damage."""
        for mesh, place in enumerate(self._meshes):
            for side in (0, 1):
                first = side * OF_SIDE
                for gear, pair in enumerate(parts_of_mesh(mesh, len(self._meshes) // 2, side)):
                    for part, row in zip(pair, (FLANK_DAMAGE, ROOT_DAMAGE), strict=True):
                        yield part, side, False, first + row + gear, place
                        yield part, side, True, first + PASSAGE, place
        for k in range(len(self._meshes) // 2):
            yield f"planet_{k + 1}_bearing", 0, False, BEARING_DAMAGE, self._meshes[k]
        for c, shaft in enumerate(SHAFTS):
            yield f"{shaft}_shaft", 0, False, SHAFT_DAMAGE, c
        for b, member in enumerate(MEMBERS):
            yield f"{member}_bearing", 0, False, MEMBER_DAMAGE, b

    def _peaks(self) -> list[list[tuple[int, int]]]:
        """Row and place of each of the extremes whose largest one is a peak, peak by peak."""
        roots = dict[str, list[tuple[int, int]]]()
        for mesh, place in enumerate(self._meshes):
            for gear, (_, root) in enumerate(parts_of_mesh(mesh, len(self._meshes) // 2, 0)):
                roots.setdefault(root, []).append((ROOT_STRESS + gear, place))
        if "ring_root" not in self.parts:
            del roots["ring_root"]
        contact, hottest, roughest = (
            [[(row, place)] for place in self._meshes]
            for row in (CONTACT_STRESS, HOTTEST, ROUGHEST)
        )
        return [*contact, *roots.values(), *hottest, *roughest]
