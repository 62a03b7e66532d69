"""Readings of sensors over consecutive windows."""

from __future__ import annotations

import math
from collections.abc import Iterable

from ..sensors.sensed import Readings, joined_readings

EARLY = 1e-6  # periods by which rounding may make a reading seem late


def by_sensor(parts: Iterable[Readings], after: float = -math.inf) -> dict[str, Readings]:
    """Join consecutive readings of each sensor.

    Args:
        parts: readings of any sensors, those of each in the order of time.
        after: time of the last reading that is left out [s].
    """
    found: dict[str, list[Readings]] = {}
    for part in parts:
        found.setdefault(part.name, []).append(part)
    return {name: _later(joined_readings(each), after) for name, each in found.items()}


def _later(readings: Readings, after: float) -> Readings:
    """The readings without those up to a time [s]."""
    late = readings.time > after + EARLY * readings.period
    skipped = len(late) - int(late.sum())
    first = readings.first + skipped * readings.period
    return readings._replace(first=first, values=readings.values[skipped:])
