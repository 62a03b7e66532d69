"""Remarks on readings that are not what they seem."""

from __future__ import annotations

from collections.abc import Iterator

from .sensed import Readings

ALIASES = 1e-4  # of the largest line, allowed


def reading_remarks(readings: Readings) -> Iterator[str]:
    """Say how readings depart from what the sensor is exposed to.

    Args:
        readings: of a whole run.

    Yields:
        A sentence for each remark, which starts with the name of the sensor.
    """
    if readings.clipped:
        yield (
            f"{readings.name}: {readings.clipped} of {len(readings.values)} samples are beyond the "
            "range of the sensor and clipped"
        )
    yield from alias_remarks(readings)


def alias_remarks(readings: Readings) -> Iterator[str]:
    """Say that aliases are too large, if that is known.

    Args:
        readings: of any part of a run.

    Yields:
        One sentence at most.
    """
    if readings.aliases > ALIASES:
        yield (
            f"{readings.name}: aliases of up to {readings.aliases:.2g} of the largest line, as "
            "teeth excite frequencies above half the rate at which the sensor is sampled before "
            f"its filter: should be at most {ALIASES:g}; give the sensor a larger oversampling, or "
            "measure_vibration a run with a higher sample_rate"
        )
