"""A torque transducer on a shaft."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from ..quantity import Section, quantity
from .sensor import FilteredSensor, bits_field, range_field, rate_field


class TorqueErrors(Section):
    """Errors of a torque transducer."""

    noise: float = quantity("N m", "standard deviation of a reading", 0.0, ge=0.0, le=1e6)
    zero: float = quantity("N m", "error of the zero", 0.0, ge=-1e6, le=1e6)
    gain: float = quantity("", "relative error of the gain", 0.0, gt=-1.0, le=1.0)


class Torque(TorqueErrors, FilteredSensor):
    """A torque transducer between a machine and the gearset.

    It has the response of second order of a Butterworth filter. A filter in front of the sampling
    passes 0.4 of the rate and stops what would be an alias.
    """

    kind: Literal["torque"] = Field(description="torque of a machine on its shaft")
    shaft: Literal["input", "output", "second_input"] = Field("input", description="shaft")
    rate: float = rate_field(6400.0)
    bandwidth: float = quantity("Hz", "at which 0.71 of a torque is left", 1e3, gt=0.0, le=1e6)
    range: float | None = range_field("N m")
    bits: int = bits_field()
    noise: float = quantity("N m", "standard deviation of a sample", 0.1, ge=0.0, le=1e6)
