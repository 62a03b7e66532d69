"""An accelerometer on the housing, above the ring."""

from __future__ import annotations

import math
from typing import Literal, Self

from pydantic import Field, model_validator

from ..quantity import quantity
from .paths import FilteredWindow, RigidRing, TransferPath, TransferWindow
from .sensor import LEAST_OVERSAMPLING, NAME, FilteredSensor, bits_field, range_field, rate_field

STOPPED = 0.6  # of the sample rate: from there on the filter of a sensor stops


class Accelerometer(FilteredSensor):
    """An accelerometer on the housing, above the ring.

    A filter in front of the sampling passes 0.4 of the rate and stops what would be an alias.
    """

    kind: Literal["accelerometer"] = Field(
        "accelerometer", description="acceleration of the housing"
    )
    name: str = Field("ring", pattern=NAME, description="name of the sensor")
    angle: float = quantity(
        "rad", "place on the housing, counter-clockwise as planet_angles", math.radians(90.0),
        ge=-10.0, le=10.0,
    )  # fmt: skip
    direction: Literal["radial", "tangential"] = Field(
        "radial",
        description="axis of the sensor: outwards, or counter-clockwise; paths with law window "
        "and filter have no direction",
    )
    rate: float = rate_field(25_600.0)
    oversampling: int = Field(
        16, ge=LEAST_OVERSAMPLING, le=64,
        description="samples before the filter, at least, for each behind it; more cost more and "
        "leave smaller aliases of what teeth excite far above the rate",
    )  # fmt: skip
    path: TransferPath = Field(TransferWindow(), description="path from the teeth to the sensor")
    resonance: float | None = quantity(
        "Hz", "natural frequency of the sensor on its mounting; none: above all frequencies", None,
        gt=0.0, le=1e6,
    )  # fmt: skip
    damping_ratio: float = quantity("", "of the resonance of the sensor", 0.02, ge=0.005, lt=1.0)
    high_pass: float = quantity(
        "Hz", "cut-off frequency of the amplifier, of first order; 0: it passes everything", 0.0,
        ge=0.0, le=1e4,
    )  # fmt: skip
    range: float | None = range_field("m/s^2")
    bits: int = bits_field()
    noise: float = quantity("m/s^2", "standard deviation of a sample", 0.05, ge=0.0, le=1e6)

    @model_validator(mode="after")
    def _path_fits(self) -> Self:
        path, across = self.path, self.direction == "tangential"
        if across and isinstance(path, (TransferWindow, FilteredWindow)):
            raise ValueError(
                f"direction = 'tangential': must be radial with path.law = {path.law}, which has "
                "no direction; or set path.law = resolved"
            )
        if across and isinstance(path, RigidRing) and path.radius is None:
            raise ValueError("path.radius: required with direction = tangential")
        if isinstance(path, FilteredWindow) and path.table:
            last, needed = path.table[-1].frequency, STOPPED * self.rate
            if last < needed:
                raise ValueError(
                    f"path.table: ends at {last:g} Hz: must reach {STOPPED:g} of the rate, "
                    f"{needed:g} Hz"
                )
        return self
