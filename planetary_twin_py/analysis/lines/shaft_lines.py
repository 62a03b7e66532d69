"""Names lines at the rotation of sun, planets, ring and carrier, and at its multiples.

Unbalance, misalignment and runout vibrate once, twice or three times per turn. A planet turns on
its pin with its speed relative to the carrier.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple, Self

from ...model.layout import Layout
from ...scene import Scene

MULTIPLES = 3  # of the speeds that are named
RESOLVED = 4.0  # [bins] distance from zero below which a line with a Hann window overlaps itself


class ShaftLine(NamedTuple):
    """Place of a line at a multiple of the speed of a member."""

    member: str
    """Member that turns."""
    multiple: int
    """Vibrations per turn."""


@dataclass(frozen=True)
class ShaftLines:
    """Rotation of the members of a gearbox."""

    orders: Mapping[str, float]
    """Turns of each member per mesh cycle [mesh orders]."""

    @classmethod
    def of(cls, scene: Scene) -> Self:
        """Rotation of all members that turn.

        There is none of a differential: the speeds of its members over that of the meshes vary.

        Args:
            scene: scene of the gearbox.
        """
        ratios = Layout(scene).ratios
        (sun, *second), carrier = ratios["sun"], ratios["carrier"][0]
        if second:
            return cls({})
        turns = {name: ratios[name][0] for name in ("sun", "planet", "ring", "carrier")}
        if carrier:
            turns["planet on its pin"] = turns["planet"] - carrier
        cycles = scene.gearset.teeth.sun * (sun - carrier)
        return cls({name: abs(float(turn / cycles)) for name, turn in turns.items() if turn})

    def at(self, orders: float, resolution: float) -> list[ShaftLine]:
        """Rotations that coincide with a line, the lowest multiples first.

        Args:
            orders: place of the line [mesh orders].
            resolution: of the spectrum [mesh orders].
        """
        return [] if orders < RESOLVED * resolution else self.near(orders, resolution)

    def place(self, line: ShaftLine) -> float:
        """Place of a rotation [mesh orders].

        Args:
            line: of a member of `orders`.
        """
        return line.multiple * self.orders[line.member]

    def near(self, orders: float, within: float) -> list[ShaftLine]:
        """Rotations up to a distance from a line, the lowest multiples first.

        Args:
            orders: place of the line [mesh orders].
            within: the distance [mesh orders].
        """
        found = [
            ShaftLine(member, multiple)
            for member, turn in self.orders.items()
            for multiple in range(1, MULTIPLES + 1)
            if abs(orders - multiple * turn) <= within
        ]
        return sorted(found, key=lambda one: one.multiple)


def shaft_text(lines: list[ShaftLine]) -> str:
    """Description of the rotations at a line; empty without any.

    Args:
        lines: from `ShaftLines.at`.
    """
    return " or ".join(f"{line.multiple}x {line.member}" for line in lines)
