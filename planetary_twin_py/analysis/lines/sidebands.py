"""Names the sidebands of mesh harmonics by the member whose rotation separates them.

A fault or runout modulates a mesh once per turn of its gear relative to the carrier: its sidebands
are 1/Z mesh orders apart (McFadden 1986, J. Vib. Acoust. 108(2), 165-170), and N times as far where
N equal planets are seen together. If the carrier turns, planets pass a sensor on the housing, and
its sidebands are apart by the speed of the carrier.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import groupby
from typing import NamedTuple, Self

from ...model.layout import Layout
from ...scene import Scene

MOST = 3  # sidebands on each side of a harmonic that are named, or one for each planet if more
RESOLVED = 4.0  # [bins] distance below which lines with a Hann window overlap


class Sideband(NamedTuple):
    """Place of a line beside a mesh harmonic."""

    harmonic: int
    """Number of the mesh harmonic."""
    member: str
    """Member whose rotation separates the sidebands."""
    number: int
    """Number of the sideband, negative below the harmonic."""


@dataclass(frozen=True)
class Sidebands:
    """Sidebands of a gearbox."""

    spacing: Mapping[str, float]
    """Distance of the sidebands of each member [mesh orders]."""
    most: int
    """Largest number of a sideband on each side of a harmonic."""

    @classmethod
    def of(cls, scene: Scene) -> Self:
        """Sidebands of all gears, and of the carrier if it turns.

        Those of the carrier of a differential are missing: its speed over that of the meshes
        varies.

        Args:
            scene: scene of the gearbox.
        """
        teeth = scene.gearset.tooth_numbers
        found = {name: 1.0 / count for name, count in teeth._asdict().items()}
        ratios = Layout(scene).ratios
        (sun, *second), carrier = ratios["sun"], ratios["carrier"][0]
        if carrier and not second:
            found["carrier"] = abs(float(carrier / (teeth.sun * (sun - carrier))))
        return cls(found, max(MOST, scene.gearset.planets))

    def resolved(self, resolution: float) -> Self:
        """Those of the members whose sidebands a spectrum separates from each other.

        Args:
            resolution: of the spectrum [mesh orders].
        """
        least = RESOLVED * resolution
        return replace(self, spacing={m: each for m, each in self.spacing.items() if each >= least})

    def place(self, sideband: Sideband) -> float:
        """Place of a sideband [mesh orders].

        Args:
            sideband: of a member of `spacing`.
        """
        return sideband.harmonic + sideband.number * self.spacing[sideband.member]

    def at(self, orders: float, resolution: float) -> list[Sideband]:
        """Sidebands that coincide with a line, those of the lowest number first.

        If there is one, those of other members up to twice the largest number are listed as well:
        a line at two places does not show which member it is of.

        Args:
            orders: place of the line [mesh orders].
            resolution: largest distance of a sideband from the line [mesh orders].
        """
        found = []
        for harmonic in {int(orders), int(orders) + 1} - {0}:
            for member, distance in self.spacing.items():
                number = round((orders - harmonic) / distance)
                away = abs(harmonic + number * distance - orders)
                if away <= resolution and 0 < abs(number) <= 2 * self.most:
                    found.append(Sideband(harmonic, member, number))
        if not any(abs(one.number) <= self.most for one in found):
            return []
        return sorted(found, key=lambda one: (abs(one.number), one.harmonic))


def sideband_text(sidebands: list[Sideband]) -> str:
    """Description of the sidebands at a line; empty without any.

    Args:
        sidebands: from `Sidebands.at`.
    """
    groups = groupby(sidebands, lambda one: (one.harmonic, one.number))
    return "; ".join(
        f"sideband {number:+d} of harmonic {harmonic}: "
        + " or ".join(one.member for one in members)
        for (harmonic, number), members in groups
    )
