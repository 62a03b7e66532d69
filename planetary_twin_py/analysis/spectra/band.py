"""Ranges of the axis of a spectrum."""

from __future__ import annotations

import math
from typing import NamedTuple

from ...units.conversion import to_si


class Band(NamedTuple):
    """Range of the axis from `low` to `high` [Hz, or cycles per turn], both included."""

    low: float
    high: float


def read_band(text: str, unit: str, name: str = "band") -> Band:
    """Parse a band.

    Args:
        text: ``low:high``, numbers in `unit` or with a unit.
        unit: "Hz", or "" for orders.
        name: of the band, for messages.

    Returns:
        The band in `unit`.

    Raises:
        ValueError: the text is not a band, or not 0 <= low < high.
    """
    ends = text.split(":")
    try:
        low, high = (float(str(to_si(end.strip(), unit))) for end in ends)
    except ValueError:
        raise _error(text, unit, name) from None
    if not 0.0 <= low < high < math.inf:
        raise _error(text, unit, name)
    return Band(low, high)


def _error(text: str, unit: str, name: str) -> ValueError:
    return ValueError(
        f"{name} = {text!r}: must be low:high in {unit or 'orders'}, 0 <= low < high, e.g. 400:600"
    )
