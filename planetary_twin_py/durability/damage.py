"""Damage of the parts of a gearbox over some time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..text.object_repr import brief

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Damage:
    """Miner sums of the parts of a gearbox: failure is expected at 1."""

    duration: float
    """Time that it covers [s]."""
    parts: tuple[str, ...]
    """Names of the parts, see `durability.parts`."""
    damage: Array
    """Miner sum of the time covered [-], of gears the mean over their teeth, (parts,)."""
    passages: NDArray[np.int64]
    """Passages of a tooth through a mesh, of all teeth of a part together; 0 for bearings,
    (parts,)."""
    teeth: NDArray[np.int64]
    """Teeth of each part; 1 for bearings, (parts,)."""
    peaks: Mapping[str, Array] = field(default_factory=dict)
    """Extremes of the time covered by name, see `PEAKS`; of each part or mesh."""

    @property
    def rate(self) -> Array:
        """Miner sum over time [1/s], (parts,)."""
        return self.damage / self.duration

    @property
    def passages_per_tooth(self) -> Array:
        """Mean number of passages of each tooth, (parts,)."""
        per_tooth: Array = self.passages / self.teeth
        return per_tooth

    @property
    def shortest_lived(self) -> str:
        """Name of the part with the largest damage, "" if there is none."""
        return self.parts[int(np.argmax(self.damage))] if self.damage.any() else ""

    def __repr__(self) -> str:
        """One line."""
        worst = self.shortest_lived or "none"
        return brief(self, f"{self.duration:g} s", f"{len(self.parts)} parts", f"largest: {worst}")
