"""A tachometer on a shaft."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from ..quantity import quantity
from .sensor import Sensor, Shaft


class Tachometer(Sensor):
    """Marks on a shaft, whose first edges a counter stamps with the time."""

    kind: Literal["tachometer"] = Field(description="times of pulses per turn of a shaft")
    shaft: Shaft = Field("input", description="shaft or member with the marks")
    pulses: int = Field(1, ge=1, le=10_000, description="per turn, the first one at angle 0")
    width: float = quantity(
        "", "of a mark over their distance; a shaft that turns backwards shows its other edge",
        0.5, gt=0.0, lt=1.0,
    )  # fmt: skip
    clock: float = quantity("Hz", "of the counter, whose ticks are the times", 5e6, gt=0.0, le=1e12)
    noise: float = quantity("s", "standard deviation of the time of an edge", 1e-7, ge=0.0, le=1.0)
