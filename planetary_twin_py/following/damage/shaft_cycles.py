"""Damage of the shafts of real gearboxes: cycles of the measured torque, as they close."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ...durability.damage_state import DamageState
from ...durability.parts import SHAFTS
from ...durability.rainflow import Rainflow
from ...scene import Scene
from ...scene.durability.shafts import RatedShaft
from .rows import Rows

Array = NDArray[np.float64]


class ShaftCycles:
    """Counts cycles of the torque of the rated shafts of some gearboxes.

    Args:
        scene: scene of the type, with its section `durability`.
        ratio: speed of the output over that of the input.
    """

    def __init__(self, scene: Scene, ratio: float) -> None:
        durability = scene.durability
        rated = {} if durability is None else {
            side: shaft for side in SHAFTS if (shaft := getattr(durability.shafts, side))
        }  # fmt: skip
        self._rated: dict[str, RatedShaft] = rated
        self._ratio = ratio
        self._counters: list[dict[str, Rainflow]] = []

    def load(self, states: Sequence[DamageState]) -> None:
        """Go on from the turning points of some states."""
        self._counters = [
            {side: Rainflow(state.turning.get(f"{side}_shaft", ())) for side in self._rated}
            for state in states
        ]

    def store(self, gearbox: int, state: DamageState) -> None:
        """Write the turning points of a gearbox to its state."""
        for side, counter in self._counters[gearbox].items():
            state.turning[f"{side}_shaft"] = counter.turns

    def add(self, rows: Rows, output_torque: Array, parts: Sequence[str], terms: Array) -> None:
        """Add the damage of the cycles that each row closes.

        Args:
            rows: the rows, (m, n).
            output_torque: measured torques of the output [N m], (m, n); NaN where there is none,
                and that of the input counts, without losses.
            parts: names of the parts.
            terms: damage of each row, (m, n, parts); changed in place.
        """
        for side, shaft in self._rated.items():
            place = parts.index(f"{side}_shaft")
            torque = rows.torque
            if side == "output":
                torque = np.where(
                    np.isfinite(output_torque), output_torque, -rows.torque / self._ratio
                )
            for row, n in np.argwhere(rows.fresh):
                counter = self._counters[n][side]
                counter.feed(torque[row, n])
                for size in counter.take_closed():
                    per_cycle = (size / shaft.range) ** shaft.exponent / shaft.reference_cycles
                    terms[row, n, place] += per_cycle
