"""What all sensors of a scene have."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import Field

from ..quantity import Section, quantity

MOST_SENSORS = 8
LEAST_OVERSAMPLING = 4  # of a sensor with a filter
NAME = r"^[a-z][a-z0-9_]*$"

Shaft = Literal["input", "output", "second_input", "sun", "ring", "carrier"]


class Sensor(Section):
    """A sensor with noise of its own."""

    name: str = Field(pattern=NAME, description="name of the sensor")
    kind: str = Field(description="what it senses")
    seed: int = Field(
        0,
        ge=0,
        le=10**9,
        description="of the random numbers of the noise, beside the name of the sensor",
    )


class FilteredSensor(Sensor):
    """A sensor with a filter in front of its sampling.

    The filter passes 0.4 of the rate and stops what would be an alias.
    """


def rate_field(default: float) -> Any:
    """Field for the sample rate of a sensor."""
    return quantity("Hz", "sample rate", default, gt=0.0, le=1e6)


def range_field(unit: str) -> Any:
    """Field for the range of a sensor."""
    return quantity(
        unit, "largest magnitude; larger ones are clipped; none: no limit and no bits", None,
        gt=0.0, le=1e7,
    )  # fmt: skip


def bits_field() -> Any:
    """Field for the bits of a converter."""
    return Field(24, ge=8, le=32, description="of the converter, over twice the range")
