"""All sensors of one value at a time, by channel; names and signs are those of gearbox_state."""

from __future__ import annotations

from .speed import speed_at
from .temperature import OIL_TEMPERATURE
from .torque import torque_at

SIDES = "input", "output"
SENSORS = {
    sensor.name: sensor
    for sensor in (
        *(measured(place) for place in SIDES for measured in (speed_at, torque_at)),
        OIL_TEMPERATURE,
    )
}
CHANNELS = {name: sensor.unit for name, sensor in SENSORS.items()}
"""SI units by channel."""
TORQUES = "input_torque", "output_torque"
OIL = OIL_TEMPERATURE.name
LOADED, MOVING = SENSORS["input_torque"].shown, SENSORS["input_speed"].shown
"""Shares of the torque and the speed of the scene below which these are not compared with it."""
