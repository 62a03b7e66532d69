"""Text of an estimate and of its interval, with the digits that the interval supports."""

from __future__ import annotations

import math

DIGITS = 2  # significant digits of half the width of an interval


def interval_text(value: float, low: float, high: float) -> tuple[str, str]:
    """Round an estimate and the ends of its interval to two digits of half its width.

    Args:
        value: the estimate.
        low: lower end of the interval; NaN: there is none.
        high: upper end.

    Returns:
        Texts of the estimate and of the interval, "-" if there is none.
    """
    if math.isnan(low):
        return f"{value:.6g}", "-"
    half = 0.5 * (high - low)
    if not 0.0 < half < math.inf:
        return f"{value:.6g}", f"{low:.6g} to {high:.6g}"
    places = DIGITS - 1 - math.floor(math.log10(half))
    shown, first, last = (f"{round(number, places):.12g}" for number in (value, low, high))
    return shown, f"{first} to {last}"
