"""Rolling bearings with a rated life."""

from __future__ import annotations

from typing import Literal, Self

from pydantic import Field, model_validator

from ..quantity import Section, quantity


class RatedBearing(Section):
    """Rating of a bearing (ISO 281); without a fatigue limit its life is the basic rating life."""

    rating: float = quantity("N", "basic dynamic load rating C of one bearing", gt=0.0, le=1e9)
    kind: Literal["roller", "ball"] = Field(description="kind of rolling elements")
    number: int = Field(1, description="bearings on the seat, which share its load", ge=1, le=8)
    fatigue_limit: float | None = quantity(
        "N", "fatigue load limit C_u of one bearing, for the modified rating life", None,
        gt=0.0, le=1e9,
    )  # fmt: skip
    mean_diameter: float | None = quantity(
        "m", "pitch diameter, for the modified rating life", None, gt=0.0, le=10.0
    )
    cleanliness: float = quantity(
        "", "e_C of the oil, from 0 (very dirty) to 1 (clean), for the modified rating life", 0.5,
        ge=0.0, le=1.0,
    )  # fmt: skip

    @model_validator(mode="after")
    def _modified_life(self) -> Self:
        if (self.fatigue_limit is None) != (self.mean_diameter is None):
            raise ValueError("fatigue_limit, mean_diameter: give both or none of them")
        return self


class RatedBearings(Section):
    """Rated bearings; parts without one collect no damage.

    The loads of sun, ring and carrier need axes that move.
    """

    planet: RatedBearing | None = Field(None, description="bearing of every planet on its pin")
    sun: RatedBearing | None = Field(None, description="bearing of the sun in the housing")
    ring: RatedBearing | None = Field(None, description="bearing of the ring in the housing")
    carrier: RatedBearing | None = Field(None, description="bearing of the carrier in the housing")
