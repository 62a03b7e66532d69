"""Sensors on a gearbox: where they are, what they sense, and how they record it; a kind a file."""

from __future__ import annotations

from typing import Annotated

from pydantic import Discriminator, Tag

from ..quantity import kind
from .accelerometer import Accelerometer
from .encoder import Encoder
from .paths import FlexibleRing, TransferWindow
from .proximity import Proximity
from .sensor import MOST_SENSORS
from .tachometer import Tachometer
from .thermometer import Thermometer
from .torque import Torque

AnySensor = Annotated[
    Annotated[Accelerometer, Tag("accelerometer")]
    | Annotated[Encoder, Tag("encoder")]
    | Annotated[Tachometer, Tag("tachometer")]
    | Annotated[Torque, Tag("torque")]
    | Annotated[Proximity, Tag("proximity")]
    | Annotated[Thermometer, Tag("thermometer")],
    Discriminator(kind),
]

__all__ = [
    "MOST_SENSORS",
    "Accelerometer",
    "AnySensor",
    "Encoder",
    "FlexibleRing",
    "Proximity",
    "Tachometer",
    "Thermometer",
    "Torque",
    "TransferWindow",
]
