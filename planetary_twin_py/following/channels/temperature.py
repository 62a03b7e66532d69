"""The thermometer of the oil. Messages state degrees Celsius, readings are in K."""

from __future__ import annotations

from .sensor import Range, Sensor

COLDEST, HOTTEST = 200.0, 475.0  # [K] of oil
ZERO_CELSIUS = 273.15  # [K]

OIL_TEMPERATURE = Sensor(
    "oil_temperature", "temperature", "K", ("degC", "degF"),
    lambda train: train.oil_temperature,
    lambda _: Range(
        COLDEST, HOTTEST,
        f"the range of an oil, {COLDEST:g} to {HOTTEST:g} K (messages are in degrees Celsius)",
    ),
    written=((1.0, 0.0), (1.0, -ZERO_CELSIUS)),
)  # fmt: skip
