"""Temperature of the oil. Messages state degrees Celsius, readings are in K."""

from __future__ import annotations

from ..train import FollowedTrain
from .sensor import Array, Range, Sensor

COLDEST, HOTTEST = 200.0, 475.0  # [K] of oil
ZERO_CELSIUS = 273.15  # [K]


class Temperature(Sensor):
    """A thermometer."""

    quantity, unit, spellings = "temperature", "K", "K or degC"

    def nominal(self, train: FollowedTrain) -> float:
        """Temperature of the scene [K]."""
        return train.oil_temperature

    def limits(self, train: FollowedTrain) -> Range:
        """Temperatures that an oil can have [K]."""
        return Range(COLDEST, HOTTEST, "the range of an oil")

    def as_written(self, values: Array) -> list[Array]:
        """Readings in K and in degrees Celsius."""
        return [values, values - ZERO_CELSIUS]

    def beyond(self, allowed: Range) -> str:
        """Why a reading beyond the limits is left out."""
        limits = f"{allowed.low:g} and {allowed.high:.4g} {self.unit}"
        return f"it must be within {limits} (messages are in degrees Celsius)"

    def refusal(self, allowed: Range) -> str:
        """The range of a channel most of whose readings are beyond it, and how to state a unit."""
        return (
            f"must be within {allowed.low:g} and {allowed.high:g} K; a column in degrees Celsius "
            f"is headed {self.name} [degC], and messages are in degrees Celsius"
        )
