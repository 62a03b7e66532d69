"""Errors of position and form that make planets share the load unevenly."""

from __future__ import annotations

from pydantic import Field

from .quantity import Section, quantity

LARGEST = 1e-2  # [m]
_PLANETS = 7  # at most


class Offset(Section):
    """Offset of an axis from that of the housing, in a direction of the housing."""

    size: float = quantity("m", "offset", 0.0, ge=0.0, le=LARGEST)
    angle: float = quantity(
        "rad", "direction, from the x axis counter-clockwise", 0.0, ge=-100.0, le=100.0
    )


class Errors(Section):
    """Deviations of gears and carrier from their nominal positions and dimensions.

    Lists have an entry for each planet; an empty list means zeros. The eccentricities of the gears
    are in `mesh.runout`; their phases are here.
    """

    pin_radial: tuple[float, ...] = quantity(
        "m", "displacements of the pins outwards", (), max_length=_PLANETS
    )
    pin_tangential: tuple[float, ...] = quantity(
        "m", "displacements of the pins counter-clockwise", (), max_length=_PLANETS
    )
    planet_thickness: tuple[float, ...] = quantity(
        "m", "by which the teeth of the planets are thicker, on the pitch circle", (),
        max_length=_PLANETS,
    )  # fmt: skip
    sun_runout_phase: float = quantity(
        "rad", "angle of mesh.runout.sun at the start", 0.0, ge=-100.0, le=100.0
    )
    ring_runout_phase: float = quantity(
        "rad", "angle of mesh.runout.ring at the start", 0.0, ge=-100.0, le=100.0
    )
    planet_runout_phases: tuple[float, ...] = quantity(
        "rad", "angles of mesh.runout.planet at the start", (), max_length=_PLANETS
    )
    ring_offset: Offset = Field(Offset(), description="offset of the ring from the housing")
    carrier_offset: Offset = Field(Offset(), description="offset of the carrier from the housing")

    @property
    def of_axes(self) -> bool:
        """Whether an axis is off that of the housing."""
        return bool(self.ring_offset.size or self.carrier_offset.size)

    def of_planet(self, planet: int) -> tuple[float, ...]:
        """Displacements of the pin, thickness of the teeth, phase of the runout of a planet.

        Args:
            planet: counted from 0.

        Returns:
            Radial and tangential displacement of the pin [m], thickness [m], phase [rad].
        """
        lists = (
            self.pin_radial, self.pin_tangential, self.planet_thickness, self.planet_runout_phases,
        )  # fmt: skip
        return tuple(values[planet] if values else 0.0 for values in lists)
