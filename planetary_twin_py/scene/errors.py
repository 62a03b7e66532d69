"""Errors of position and form that make planets share the load unevenly."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple, Self

from pydantic import Field, model_validator

from .quantity import Section, quantity, within

LARGEST = 1e-2  # [m]
_PLANETS = 7  # at most
FACTORS = (0.01, 100.0)  # range of factors on a stiffness
LENGTHS = (-LARGEST, LARGEST)  # [m]
PHASES = (-100.0, 100.0)  # [rad]


def _each(ends: tuple[float, float]) -> str:
    """Words for the range of the entries of a list."""
    return f"each within {ends[0]:g} and {ends[1]:g}"


class PlanetErrors(NamedTuple):
    """Deviations of one planet."""

    pin_radial: float = 0.0
    """Displacement of the pin outwards [m]."""
    pin_tangential: float = 0.0
    """Displacement of the pin counter-clockwise [m]."""
    thickness: float = 0.0
    """By which its teeth are thicker [m]."""
    runout_phase: float = 0.0
    """Angle of its runout at the start [rad]."""
    stiffness: float = 1.0
    """Factor on the stiffness of both meshes."""
    pin_stiffness: float = 1.0
    """Factor on the radial stiffness of its bearing."""

    @property
    def uneven(self) -> bool:
        """Whether the planet differs from its nominal position, dimensions and stiffness."""
        return self._replace(runout_phase=0.0) != PlanetErrors()


class Offset(Section):
    """Offset of an axis from that of the housing, in a direction of the housing."""

    size: float = quantity("m", "offset", 0.0, ge=0.0, le=LARGEST)
    angle: float = quantity(
        "rad", "direction, from the x axis counter-clockwise", 0.0, ge=PHASES[0], le=PHASES[1]
    )


class Errors(Section):
    """Deviations of gears and carrier from their nominal positions and dimensions.

    Lists have an entry for each planet; an empty list means zeros, or factors of 1. The
    eccentricities of the gears are in `mesh.runout`; their phases are here.
    """

    pin_radial: tuple[float, ...] = quantity(
        "m", f"displacements of the pins outwards, {_each(LENGTHS)}", (), max_length=_PLANETS
    )
    pin_tangential: tuple[float, ...] = quantity(
        "m", f"displacements of the pins counter-clockwise, {_each(LENGTHS)}", (),
        max_length=_PLANETS,
    )  # fmt: skip
    planet_thickness: tuple[float, ...] = quantity(
        "m", "by which the teeth of the planets are thicker, on the pitch circle, "
        f"{_each(LENGTHS)}", (), max_length=_PLANETS,
    )  # fmt: skip
    sun_runout_phase: float = quantity(
        "rad", "angle of mesh.runout.sun at the start", 0.0, ge=-100.0, le=100.0
    )
    ring_runout_phase: float = quantity(
        "rad", "angle of mesh.runout.ring at the start", 0.0, ge=-100.0, le=100.0
    )
    planet_runout_phases: tuple[float, ...] = quantity(
        "rad", f"angles of mesh.runout.planet at the start, {_each(PHASES)}", (),
        max_length=_PLANETS,
    )  # fmt: skip
    planet_stiffness: tuple[float, ...] = quantity(
        "", "factors on the stiffness of both meshes of the planets, "
        f"{_each(FACTORS)}", (), max_length=_PLANETS,
    )  # fmt: skip
    pin_stiffness: tuple[float, ...] = quantity(
        "", "factors on supports.planet.bearing, the radial stiffness of the planets on their "
        f"pins, {_each(FACTORS)}", (), max_length=_PLANETS,
    )  # fmt: skip
    ring_offset: Offset = Field(Offset(), description="offset of the ring from the housing")
    carrier_offset: Offset = Field(Offset(), description="offset of the carrier from the housing")

    @model_validator(mode="after")
    def _entries_in_range(self) -> Self:
        for name, ((low, high), unit) in _RANGES.items():
            for place, value in enumerate(getattr(self, name), 1):
                if not low <= value <= high:
                    given = f"{name} = {value:g} {unit}".rstrip()
                    raise ValueError(f"{given} of planet {place}: {within(low, high, unit)}")
        return self

    @property
    def of_axes(self) -> bool:
        """Whether an axis is off that of the housing."""
        return bool(self.ring_offset.size or self.carrier_offset.size)

    def with_pins(self, moved: Mapping[int, tuple[float, float]], planets: int) -> Errors:
        """The errors with further displacements of pins.

        Args:
            moved: outwards and counter-clockwise [m], by the number of the planet.
            planets: number of planets.
        """
        if not moved:
            return self
        sums = {}
        for place, name in enumerate(("pin_radial", "pin_tangential")):
            values = getattr(self, name) or (0.0,) * planets
            further = (moved.get(n, (0.0, 0.0))[place] for n in range(1, planets + 1))
            sums[name] = tuple(map(sum, zip(values, further, strict=True)))
        return self.model_copy(update=sums)

    def of_planet(self, planet: int) -> PlanetErrors:
        """Deviations of a planet.

        Args:
            planet: counted from 0.
        """
        given = zip(PlanetErrors._fields, PER_PLANET, strict=True)
        lists = {field: getattr(self, name) for field, name in given}
        return PlanetErrors(**{field: values[planet] for field, values in lists.items() if values})


PER_PLANET = (
    "pin_radial", "pin_tangential", "planet_thickness", "planet_runout_phases",
    "planet_stiffness", "pin_stiffness",
)  # fmt: skip
"""Fields of `Errors` with an entry for each planet, in the order of `PlanetErrors`."""

_RANGES = {
    "pin_radial": (LENGTHS, "m"),
    "pin_tangential": (LENGTHS, "m"),
    "planet_thickness": (LENGTHS, "m"),
    "planet_runout_phases": (PHASES, "rad"),
    "planet_stiffness": (FACTORS, ""),
    "pin_stiffness": (FACTORS, ""),
}
"""Range and unit of the entries of the lists of `Errors`."""
