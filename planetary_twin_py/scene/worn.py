"""Worn flanks of all teeth, as profiles along the path of contact."""

from __future__ import annotations

from itertools import pairwise
from typing import Self

from pydantic import Field, model_validator

from .quantity import Section, quantity, within

MOST_POINTS = 400
DEEPEST = 1e-3  # [m]
_FURTHER = (-DEEPEST, DEEPEST)  # [m]


class WornMesh(Section):
    """Depth of wear of the loaded flanks of one kind of mesh.

    It is linear between the positions, and constant outside. Depths are normal to the flank, the
    missing material of a pair along the line of action. All teeth of a gear have the same wear.
    """

    position: tuple[float, ...] = quantity(
        "", "positions on the path of contact, after the pitch point [base pitches], increasing",
        min_length=2, max_length=MOST_POINTS,
    )  # fmt: skip
    first: tuple[float, ...] = quantity(
        "m", "depths of the flanks of the sun, or of the planets in mesh with the ring, there",
        min_length=2, max_length=MOST_POINTS,
    )  # fmt: skip
    second: tuple[float, ...] = quantity(
        "m", "depths of the flanks of the planets, or of the ring, there",
        min_length=2, max_length=MOST_POINTS,
    )  # fmt: skip
    planets: tuple[float, ...] = quantity(
        "m", "depths by which each planet is worn further than all of them on average; none: "
        "all the same", (), max_length=7,
    )  # fmt: skip

    @model_validator(mode="after")
    def _a_depth_at_each_position(self) -> Self:
        if not all(low < high for low, high in pairwise(self.position)):
            raise ValueError("position: must increase")
        for name in ("first", "second"):
            depths = getattr(self, name)
            if len(depths) != len(self.position):
                raise ValueError(
                    f"{name}: has {len(depths)} depths: must have {len(self.position)}, one a "
                    "position"
                )
            for place, depth in enumerate(depths):
                if not 0.0 <= depth <= DEEPEST:
                    raise ValueError(f"{name}.{place} = {depth:g}: {within(0.0, DEEPEST, 'm')}")
        for place, depth in enumerate(self.planets):
            if abs(depth) > DEEPEST:
                raise ValueError(f"planets.{place} = {depth:g}: {within(*_FURTHER, 'm')}")
        return self


class WornFlanks(Section):
    """Worn flanks of all teeth, those that are loaded by the torque of the operating point.

    Stiffness and load sharing of a mesh are those of this torque, as with tip relief; contacts of
    the other flanks have the same profile. `planetary-twin wear` computes it.
    """

    sun_planet: WornMesh | None = Field(None, description="of the sun-planet meshes")
    planet_ring: WornMesh | None = Field(None, description="of the planet-ring meshes")

    @property
    def meshes(self) -> tuple[WornMesh | None, WornMesh | None]:
        """Of sun-planet and planet-ring meshes."""
        return self.sun_planet, self.planet_ring

    def of_planet(self, planet: int) -> tuple[float, float]:
        """Depths by which a planet is worn further, in mesh with sun and with ring [m].

        Args:
            planet: counted from 0.
        """
        sun, ring = (
            mesh.planets[planet] if mesh is not None and mesh.planets else 0.0
            for mesh in self.meshes
        )
        return sun, ring
