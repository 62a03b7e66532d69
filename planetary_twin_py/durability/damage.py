"""Damage of the parts of a gearbox over some time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..text.object_repr import brief
from .sums import Sums
from .teeth import OfTeeth

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
    """Extremes of the time covered by name; NaN where there is none.

    contact_stress: contact stress after Hertz at the dynamic load [Pa], of each mesh.
    root_stress: root stress at the dynamic load [Pa], of sun, planets and, if its root is counted,
    the ring: after ISO 6336-3 method B factors, of the ring by boundary elements.
    contact_temperature: contact temperature (Blok) [K], of each mesh; gears are as warm as the oil
    unless temperatures are states.
    specific_film: smallest film thickness over composite roughness [-], of each mesh.
    """
    of_teeth: OfTeeth = field(default_factory=OfTeeth.nothing)
    """Miner sums and passages of every tooth of the flanks and roots, if the scene asks for them:
    `damage` is their mean. Teeth are numbered as those of faults."""

    turning: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    """Turning points of the torques of rated shafts at the end that are in no closed cycle yet
    [N m], by shaft."""

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


class DamageTotal:
    """Adds up the damage of consecutive times, without rounding errors of long sums."""

    def __init__(self) -> None:
        self._first: Damage | None = None
        self._duration, self._sum = Sums.zero(), Sums.zero()
        self._passages = np.zeros(0, dtype=np.int64)
        self._peaks: dict[str, Array] = {}
        self._teeth: dict[str, Sums] = {}
        self._passages_of_teeth: dict[str, NDArray[np.int64]] = {}

    def add(self, damage: Damage) -> None:
        """Add the damage of a further time, of the same parts."""
        if self._first is None:
            self._first, self._peaks = damage, dict(damage.peaks)
            self._passages = np.zeros_like(damage.passages)
            self._sum = Sums.zero(len(damage.parts))
            self._teeth = {part: Sums.zero(n.size) for part, n in damage.of_teeth.damage.items()}
        self._duration.add([damage.duration])
        self._sum.add(damage.damage[np.newaxis])
        self._passages = self._passages + damage.passages
        for name, values in damage.peaks.items():
            extreme = np.fmin if name == "specific_film" else np.fmax
            self._peaks[name] = extreme(self._peaks[name], values)
        before = self._passages_of_teeth
        for part, sums in self._teeth.items():
            sums.add(damage.of_teeth.damage[part][np.newaxis])
            before[part] = before.get(part, 0) + damage.of_teeth.passages[part]

    @property
    def total(self) -> Damage | None:
        """The damage of all times; None if there is none."""
        first = self._first
        if first is None:
            return None
        duration, damage = float(self._duration.total), self._sum.total
        return Damage(
            duration, first.parts, damage, self._passages, first.teeth, dict(self._peaks),
            OfTeeth(
                {part: sums.total for part, sums in self._teeth.items()},
                dict(self._passages_of_teeth),
            ),
        )  # fmt: skip
