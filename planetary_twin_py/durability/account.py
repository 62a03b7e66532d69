"""Damage of the parts of a gearbox, from the sums of its meshes in the core."""

from __future__ import annotations

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
from .parts import MEMBERS, SHAFTS, part_names
from .teeth import OfTeeth, Teeth

Array = NDArray[np.float64]
_DRIVE, _COAST = 0, OF_SIDE  # first rows of both sides


class Account:
    """Adds up damage of meshes to that of parts.

    Args:
        scene: the gearbox, with its section `durability`.
    """

    def __init__(self, scene: Scene) -> None:
        self.parts = part_names(scene)
        self._teeth = scene.gearset.teeth
        self._planets = scene.gearset.planets
        each = scene.durability is not None and scene.durability.teeth
        self._each = Teeth(scene, self.parts) if each else None
        self._prescribed = scene.lubrication.lambda_ratio == "prescribed"

    def damage(self, sums: MeshSums, meshes: NDArray[np.int64], duration: float) -> Damage:
        """Damage of a time.

        Args:
            sums: of the meshes over it.
            meshes: places in them of the meshes that are reported.
            duration: its length [s].

        Returns:
            The damage of each part.
        """
        meshes = meshes % len(np.unique(meshes))  # where each flank has an entry, both are the same
        rows, extremes = sums.damage[:, meshes], sums.extreme[:, meshes]
        found = {**self._sun(rows), **self._of_planets(rows), **self._ring(rows)}
        for c, side in enumerate(SHAFTS):
            found[f"{side}_shaft"] = sums.damage[SHAFT_DAMAGE, c], 0.0, 1
        for b, member in enumerate(MEMBERS):
            found[f"{member}_bearing"] = sums.damage[MEMBER_DAMAGE, b], 0.0, 1
        picked = [found[part] for part in self.parts]
        damage, passages, teeth = (np.array(column) for column in zip(*picked, strict=True))
        return Damage(
            duration, self.parts, damage / teeth, passages.astype(np.int64), teeth, {
                "contact_stress": _or_nothing(np.sqrt(extremes[CONTACT_STRESS])),
                "root_stress": self._root_stresses(extremes),
                "contact_temperature": _or_nothing(extremes[HOTTEST]),
                "specific_film": self._films(extremes[ROUGHEST]),
            },
            OfTeeth.nothing() if self._each is None else self._each.of(sums.passed(), meshes),
        )  # fmt: skip

    def _sun(self, rows: Array) -> dict[str, tuple[float, float, int]]:
        ours = rows[:, : self._planets].sum(axis=1)
        return _member("sun", ours, 0, self._teeth.sun)

    def _ring(self, rows: Array) -> dict[str, tuple[float, float, int]]:
        ours = rows[:, self._planets :].sum(axis=1)
        return _member("ring", ours, 1, self._teeth.ring)

    def _of_planets(self, rows: Array) -> dict[str, tuple[float, float, int]]:
        found, teeth = {}, self._teeth.planet
        for k in range(self._planets):
            sun, ring, name = rows[:, k], rows[:, self._planets + k], f"planet_{k + 1}"
            # the planet is the second gear of its sun mesh and the first one of its ring mesh
            for flank, drive, coast in (("sun", 0, 1), ("ring", 1, 0)):
                here, there = ((sun, ring), (ring, sun))[drive]
                found[f"{name}_flank_{flank}"] = (
                    here[_DRIVE + FLANK_DAMAGE + coast] + there[_COAST + FLANK_DAMAGE + drive],
                    here[_DRIVE + PASSAGE] + there[_COAST + PASSAGE],
                    teeth,
                )
            roots = sum(sun[side + ROOT_DAMAGE + 1] + ring[side + ROOT_DAMAGE] for side in _SIDES)
            passages = sum(sun[side + PASSAGE] + ring[side + PASSAGE] for side in _SIDES)
            found[f"{name}_root"] = roots, passages, teeth
            found[f"{name}_bearing"] = sun[BEARING_DAMAGE], 0.0, 1
        return found

    def _root_stresses(self, extremes: Array) -> Array:
        """Largest stress at the roots, in the order of the parts [Pa]."""
        first, second = extremes[ROOT_STRESS], extremes[ROOT_STRESS + 1]
        planets = np.maximum(second[: self._planets], first[self._planets :])
        ring = [second[self._planets :].max()] if "ring_root" in self.parts else []
        return _or_nothing(np.concatenate([[first[: self._planets].max()], planets, ring]))

    def _films(self, inverse: Array) -> Array:
        if self._prescribed:  # there is no film behind the ratio
            return np.full(inverse.shape, np.nan)
        with np.errstate(divide="ignore"):
            return _or_nothing(np.where(inverse > 0.0, 1.0 / inverse, 0.0))


_SIDES = (_DRIVE, _COAST)


def _member(name: str, row: Array, gear: int, teeth: int) -> dict[str, tuple[float, float, int]]:
    """Damage, passages and teeth of the flanks and the root of sun or ring, gear 0 or 1 of it."""
    sides = {"drive": _DRIVE, "coast": _COAST}
    found = {
        f"{name}_flank_{side}": (row[first + FLANK_DAMAGE + gear], row[first + PASSAGE], teeth)
        for side, first in sides.items()
    }
    roots = sum(row[first + ROOT_DAMAGE + gear] for first in sides.values())
    found[f"{name}_root"] = roots, sum(row[first + PASSAGE] for first in sides.values()), teeth
    return found


def _or_nothing(values: Array) -> Array:
    """NaN in place of 0, which stands for no value."""
    return np.where(values > 0.0, values, np.nan)
