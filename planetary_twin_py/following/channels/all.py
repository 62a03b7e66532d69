"""All sensors of one value at a time, by channel; names and signs are those of gearbox_state."""

from __future__ import annotations

from .sensor import Sensor
from .speed import Speed
from .temperature import Temperature
from .torque import Torque

SENSORS: dict[str, Sensor] = {
    sensor.name: sensor
    for sensor in (
        Speed("input"), Torque("input"), Speed("output"), Torque("output"), Temperature("oil"),
    )
}  # fmt: skip
CHANNELS = {name: sensor.unit for name, sensor in SENSORS.items()}
"""SI units by channel."""
TORQUES = "input_torque", "output_torque"
OIL = "oil_temperature"
LOADED, MOVING = Torque.shown, Speed.shown
"""Shares of the torque and the speed of the scene below which these are not compared with it."""
