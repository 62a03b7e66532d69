"""Shafts whose torque is counted in cycles."""

from __future__ import annotations

from pydantic import Field

from ..quantity import Section, quantity


class RatedShaft(Section):
    """Cycles to failure of a shaft: (range/torque range)^exponent times `reference_cycles`."""

    range: float = quantity(
        "N m", "range of the torque, largest minus smallest, that the reference cycles lead to "
        "failure", gt=0.0, le=1e10,
    )  # fmt: skip
    exponent: float = quantity("", "negative slope of the S-N curve", 5.0, ge=1.0, le=30.0)
    reference_cycles: float = quantity("", "cycles of this range", 1e7, gt=0.0, le=1e12)


class RatedShafts(Section):
    """Shafts between the machines and their members; those that are not given collect no damage."""

    input: RatedShaft | None = Field(None, description="shaft of the input")
    output: RatedShaft | None = Field(None, description="shaft of the output")
