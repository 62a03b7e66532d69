"""A part of the axis of a spectrum."""

from __future__ import annotations

import math
from typing import NamedTuple

from ..units import to_si


class Band(NamedTuple):
    """From `low` to `high` on the axis [Hz or cycles per turn], both included."""

    low: float
    high: float


def read_band(text: str, unit: str) -> Band:
    """The band that ``low:high`` tells, in `unit` ("Hz", or "" for orders) or with one of its own.

    Raises:
        ValueError: the text is none, or not a range from 0 up.
    """
    ends = text.split(":")
    try:
        low, high = (float(str(to_si(end.strip(), unit))) for end in ends)
    except ValueError:
        raise _refusal(text, unit) from None
    if not 0.0 <= low < high < math.inf:
        raise _refusal(text, unit)
    return Band(low, high)


def _refusal(text: str, unit: str) -> ValueError:
    return ValueError(
        f"band = {text!r}: must be low:high in {unit or 'orders'}, 0 <= low < high, as 400:600"
    )
