"""Temperatures of oil, gears and housing as states, with what carries their heat."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field

from .quantity import Section, quantity

NODES = ("oil", "sun", "planets", "ring", "housing")
"""Parts with a temperature, in the order of the core."""
SOURCES = ("sun_planet_meshes", "planet_ring_meshes", "bearings", "seals", "churning")
"""Sources of heat, in the order of the core."""
COLDEST, HOTTEST = 233.15, 473.15
"""Range of the temperatures [K]."""


class OilCharge(Section):
    """The oil in the housing."""

    mass: float = quantity("kg", "mass of the oil", gt=0.0, le=1e6)
    heat_capacity: float = quantity("J/(kg K)", "specific heat of the oil", 2000.0, gt=0.0, le=1e5)


class WarmGears(Section):
    """Heat of the gears; their specific heat is lubrication.solid_heat_capacity."""

    to_oil: float = quantity(
        "W/(m^2 K)", "heat transfer from both flanks of all teeth to the oil; some 200 to 2000",
        gt=0.0, le=1e6,
    )  # fmt: skip
    sun_mass: float | None = quantity(
        "kg", "mass of the sun; default: supports.sun.mass, or that of a disc with its inertia",
        None, gt=0.0, le=1e6,
    )  # fmt: skip
    ring_mass: float | None = quantity(
        "kg", "mass of the ring; default: supports.ring.mass, or that of a rim with its inertia",
        None, gt=0.0, le=1e6,
    )  # fmt: skip


class Housing(Section):
    """The housing, which takes heat from the oil and gives it to the ambient air."""

    mass: float = quantity("kg", "mass", gt=0.0, le=1e7)
    heat_capacity: float = quantity(
        "J/(kg K)", "specific heat; cast iron 460, aluminium 900", 460.0, gt=0.0, le=1e5
    )
    area: float = quantity("m^2", "outer surface", gt=0.0, le=1e4)
    height: float = quantity("m", "height of the surface, for still air", gt=0.0, le=100.0)
    emissivity: float = quantity("", "emissivity of the surface, for still air", 0.9, ge=0.0, le=1)
    from_oil: float = quantity("W/K", "conductance from the oil to the housing", gt=0.0, le=1e7)
    to_ambient: Annotated[float, Field(gt=0.0, le=1e5)] | Literal["still_air"] = quantity(
        "W/(m^2 K)",
        "heat transfer coefficient to moving air; or still_air: free convection of a vertical wall "
        "(Churchill and Chu 1975) and radiation",
        "still_air",
    )


class Cooler(Section):
    """An oil cooler with a thermostat, which opens in proportion: capacity (T - opens)."""

    capacity: float = quantity("W/K", "heat per kelvin above `opens`", gt=0.0, le=1e7)
    opens: float = quantity("K", "temperature of the oil at which it opens", ge=COLDEST, le=HOTTEST)


class Temperatures(Section):
    """Temperatures of all parts at the start."""

    oil: float = quantity("K", "temperature of the oil", ge=COLDEST, le=HOTTEST)
    sun: float = quantity("K", "temperature of the sun", ge=COLDEST, le=HOTTEST)
    planets: float = quantity("K", "temperature of the planets", ge=COLDEST, le=HOTTEST)
    ring: float = quantity("K", "temperature of the ring", ge=COLDEST, le=HOTTEST)
    housing: float = quantity("K", "temperature of the housing", ge=COLDEST, le=HOTTEST)


class Thermal(Section):
    """Temperatures as states, heated by the losses; without it, oil_temperature is given.

    The film and the friction of a mesh follow the mean temperature of its two gears, bearings and
    churning that of the oil. Half of the tooth friction of a mesh heats each gear, which at the
    pitch point is exact for equal materials; bearings and churning heat the oil, seals the housing.
    """

    ambient: float | None = quantity(
        "K", "temperature of the ambient air; sets ambient_temperature of the operating point",
        None, ge=COLDEST, le=353.15,
    )  # fmt: skip
    oil: OilCharge = Field(description="the oil in the housing")
    gears: WarmGears = Field(description="heat of the gears")
    housing: Housing = Field(description="housing, and its surface")
    cooler: Cooler | None = Field(None, description="oil cooler; none: no cooler")
    start: Temperatures | Literal["ambient", "steady"] = Field(
        "ambient",
        description="ambient: all parts have the ambient temperature; steady: those of steady "
        "running at the operating point; or temperatures",
    )
    dead_band: float = quantity(
        "K", "change of a temperature of oil or gears up to which the viscosity is kept", 0.05,
        ge=1e-6, le=5.0,
    )  # fmt: skip


def with_ambient_in_point(data: dict[str, Any]) -> dict[str, Any]:
    """Values of a scene with `thermal.ambient`, if it is given, in the operating point."""
    thermal, point = data.get("thermal"), data.get("operating_point")
    if not isinstance(thermal, dict) or not isinstance(point, dict):
        return data
    if thermal.get("ambient") is None:
        return data
    return data | {
        "thermal": thermal | {"ambient": None},
        "operating_point": point | {"ambient_temperature": thermal["ambient"]},
    }
