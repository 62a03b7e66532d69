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
    shown, first, last = (f"{round(number, _places(half)):.12g}" for number in (value, low, high))
    return shown, f"{first} to {last}"


def plus_minus(value: float, half: float, sign: str = "") -> str:
    """Round an estimate and half the width of its interval to two digits of the latter.

    Args:
        value: the estimate.
        half: half the width of its interval.
        sign: "+" to show the sign of positive values, too.

    Returns:
        Such as "0.98 +- 0.29" or "+350 +- 19".
    """
    if not 0.0 < half < math.inf:
        return f"{value:{sign}.6g} +- {half:.2g}"
    places = _places(half)
    return f"{round(value, places):{sign}.12g} +- {round(half, places):.12g}"


def _places(half: float) -> int:
    """Decimal places of two digits of a number; negative above 100."""
    return DIGITS - 1 - math.floor(math.log10(half))
