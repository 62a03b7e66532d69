"""A thermometer in the oil."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from ..quantity import quantity
from .sensor import Sensor, rate_field


class Thermometer(Sensor):
    """A thermometer in the oil, which follows its temperature with a lag of first order."""

    kind: Literal["thermometer"] = Field(description="temperature of the oil")
    rate: float = rate_field(10.0)
    time_constant: float = quantity("s", "of the lag", 5.0, gt=0.0, le=1e5)
    noise: float = quantity("K", "standard deviation of a sample", 0.1, ge=0.0, le=1e3)
