"""A message of a sensor of a twin, or of its temperatures."""

from __future__ import annotations

from typing import Any, NamedTuple

CELSIUS = 273.15  # [K] at 0 degC


class SensorMessage(NamedTuple):
    """A message without header and number."""

    topic: str
    """Without namespace."""
    time: float
    """Simulated time in its header [s]."""
    fields: dict[str, Any]
