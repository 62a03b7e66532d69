"""Damage of a passage as a stress, which has no corner where an S-N curve has one.

Over torque, the logarithm of damage has a corner where its stress passes a corner of the S-N curve,
and steps to nothing where an endless curve ends. The stress that does this damage has neither.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..durability.parts import part_names
from ..model.gearbox import Gearbox
from ..scene import Scene
from .passages import passages_per_turn

Array = NDArray[np.float64]
GEARS = "sun", "planet", "ring"


class EquivalentStress:
    """Turns damage over angle into a logarithm that is interpolated, and back.

    Of bearings and shafts it is the logarithm of the damage itself.

    Args:
        scene: the gearbox. Where its S-N curves end (`beyond: endless`), damage over angle is that
            of `falling`, and nothing below the end of the curve on the way back.
    """

    def __init__(self, scene: Scene) -> None:
        self.falling = scene.replace(**{"durability.material.beyond": "falls"})
        """The scene with curves that go on, whose damage is turned into stress."""
        self._curves, ends = _curves(self.falling), _curves(scene)
        self._least = {part: stress[-1] for part, (stress, _) in ends.items()}
        assert scene.durability is not None
        self._endless = scene.durability.material.beyond == "endless"
        passages = passages_per_turn(scene)
        self._passages = {
            part: math.log(max(float(n) for n in passages[name]) / _share(name) / (2.0 * math.pi))
            for part, name in enumerate(part_names(scene))
            if part in self._curves
        }

    def smooth(self, damage: Array) -> Array:
        """What is interpolated; NaN without damage.

        Args:
            damage: over angle [1/rad], (..., parts).
        """
        with np.errstate(divide="ignore"):
            found = np.log(damage)
        for part, (stress, cycles) in self._curves.items():
            found[..., part] = _through(cycles, stress, self._passages[part] - found[..., part])
        return np.where(damage > 0.0, found, math.nan)

    def beyond(self, smooth: Array) -> list[int]:
        """Places of the parts with a stress above the first point of their S-N curve.

        Args:
            smooth: what is interpolated, (n, parts).
        """
        return [
            part
            for part, (stress, _) in self._curves.items()
            if (smooth[:, part] > stress[0]).any()
        ]

    def damage(self, smooth: Array) -> Array:
        """Damage over angle [1/rad], (..., parts).

        Args:
            smooth: what was interpolated, (..., parts).
        """
        found = smooth.copy()
        for part, (stress, cycles) in self._curves.items():
            level = smooth[..., part]
            found[..., part] = self._passages[part] - _through(-stress, cycles, -level)
            if self._endless:
                found[..., part][level < self._least[part]] = -math.inf
        return np.asarray(np.exp(found))


def _through(x: Array, y: Array, at: Array) -> Array:
    """The line through points of ascending x, whose first and last parts go on."""
    part = np.clip(np.searchsorted(x, at) - 1, 0, len(x) - 2)
    slope = np.diff(y) / np.diff(x)
    return np.asarray(y[part] + slope[part] * (at - x[part]))


def _share(part: str) -> int:
    """Passages of a tooth among which one does most of the damage."""
    return 2 if part.startswith("planet_") and part.endswith("_root") else 1


def _curves(scene: Scene) -> dict[int, tuple[Array, Array]]:
    """Logarithms of stress and cycles at the points of the S-N curves, by places of the parts."""
    data = Gearbox(scene).train.durability
    found = {}
    for place, part in enumerate(part_names(scene)):
        member, kind = part.split("_")[0], part.split("_", 1)[1]
        rows = data.flank if "flank" in kind else data.root if kind.endswith("root") else None
        if rows is not None:
            row = rows[GEARS.index(member)]
            points = int(row.points)
            found[place] = np.array(row.log_stress)[:points], np.array(row.log_cycles)[:points]
    return found
