"""An encoder on a shaft."""

from __future__ import annotations

from typing import Literal, Self

from pydantic import Field, model_validator

from ..quantity import quantity
from .sensor import Sensor, Shaft, rate_field

EDGES = 4  # counted for each line


class Encoder(Sensor):
    """An encoder, whose disc has lines or a code, and may be off the axis of its shaft."""

    kind: Literal["encoder"] = Field(description="counts of the angle of a shaft")
    shaft: Shaft = Field("input", description="shaft or member whose absolute angle it counts")
    rate: float = rate_field(25_600.0)
    lines: int | None = Field(
        None, ge=1, le=1_000_000, description="per turn; each has four edges, which are counted"
    )
    bits: int | None = Field(
        None, ge=8, le=32, description="counts per turn, as a power of two, instead of lines"
    )
    eccentricity: float = quantity("m", "of the disc", 0.0, ge=0.0, le=1e-2)
    radius: float | None = quantity(
        "m", "of the track of the disc; required with an eccentricity", None, gt=0.0, le=10.0
    )
    phase: float = quantity(
        "rad", "angle of the shaft at which the eccentricity points along the track", 0.0,
        ge=-10.0, le=10.0,
    )  # fmt: skip
    heads: int = Field(
        1, ge=1, le=8, description="equally spaced; more than one average the eccentricity out"
    )
    noise: float = quantity("rad", "standard deviation of a sample", 1e-6, ge=0.0, le=1.0)

    @model_validator(mode="after")
    def _disc(self) -> Self:
        if (self.lines is None) == (self.bits is None):
            raise ValueError("lines, bits: an encoder needs exactly one of them")
        if self.eccentricity and self.radius is None:
            raise ValueError("radius: required with an eccentricity")
        return self

    @property
    def counts_per_turn(self) -> int:
        """Counts of a turn."""
        return EDGES * self.lines if self.lines else int(2 ** (self.bits or 0))
