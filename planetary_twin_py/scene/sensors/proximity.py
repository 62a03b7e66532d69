"""A proximity probe beside a shaft."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from ..quantity import quantity
from .sensor import FilteredSensor, bits_field, range_field, rate_field


class Proximity(FilteredSensor):
    """A probe in the housing that measures how far a body moves towards it in the plane.

    It requires dynamics with moving axes. A filter in front of the sampling passes 0.4 of the rate
    and stops what would be an alias.
    """

    kind: Literal["proximity"] = Field(description="displacement of a body in the housing")
    body: Literal["sun", "ring", "carrier"] = Field(description="body")
    angle: float = quantity(
        "rad", "direction from the axis to the probe, counter-clockwise", 0.0, ge=-10.0, le=10.0
    )
    rate: float = rate_field(6400.0)
    range: float | None = range_field("m")
    bits: int = bits_field()
    noise: float = quantity("m", "standard deviation of a sample", 1e-7, ge=0.0, le=1.0)
