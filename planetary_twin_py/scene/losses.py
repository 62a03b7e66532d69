"""Losses outside the tooth contacts: bearings, seals and grease, and oil churning."""

from __future__ import annotations

from typing import Self

from pydantic import Field, model_validator

from .quantity import Section, quantity


class Bearing(Section):
    """Friction of a rolling bearing by Palmgren's two coefficients."""

    mean_diameter: float = quantity("m", "pitch diameter dm", gt=0.0, le=10.0)
    f0: float = quantity("", "coefficient of load-independent friction", 2.0, ge=0.0, le=100.0)
    f1: float = quantity(
        "", "coefficient of load-dependent friction, M1 = f1 F dm", 5e-4, ge=0.0, le=0.1
    )


class Drag(Section):
    """Load-independent drag torque of a member in the housing: seals, grease, preload.

    coulomb + viscous |w|, against the rotation: the friction model of a joint in robotics
    (Armstrong-Helouvry, Dupont and Canudas de Wit 1994, Automatica 30, 1083-1138).
    """

    coulomb: float = quantity("N m", "drag torque at any speed", 0.0, ge=0.0, le=1e6)
    viscous: float = quantity(
        "N m s/rad", "drag torque per speed of the member", 0.0, ge=0.0, le=1e6
    )


class Churning(Section):
    """Oil churning: members that rotate as discs in a housing with oil and air."""

    fill: float = quantity("", "volume fraction of oil in the housing", gt=0.0, le=1.0)
    gap: float = quantity("m", "gap between a disc and the wall of the housing", gt=0.0, le=1.0)
    sun: float | None = quantity(
        "m", "radius of the sun's disc; none: no churning", None, gt=0.0, le=10
    )
    ring: float | None = quantity("m", "radius of the ring's disc", None, gt=0.0, le=10.0)
    carrier: float | None = quantity("m", "radius of the carrier's disc", None, gt=0.0, le=10.0)

    @model_validator(mode="after")
    def _require_a_disc(self) -> Self:
        if self.sun is None and self.ring is None and self.carrier is None:
            raise ValueError("sun, ring, carrier: give the radius of at least one of them")
        return self


class Losses(Section):
    """Losses outside the tooth contacts; those that are not given are zero."""

    planet_bearing: Bearing | None = Field(
        None, description="bearing of every planet on the carrier"
    )
    sun_bearing: Bearing | None = Field(None, description="bearing of the sun in the housing")
    ring_bearing: Bearing | None = Field(None, description="bearing of the ring in the housing")
    carrier_bearing: Bearing | None = Field(
        None, description="bearing of the carrier in the housing"
    )
    sun_drag: Drag = Field(Drag(), description="load-independent drag of the sun")
    ring_drag: Drag = Field(Drag(), description="load-independent drag of the ring")
    carrier_drag: Drag = Field(Drag(), description="load-independent drag of the carrier")
    churning: Churning | None = Field(None, description="oil churning")
