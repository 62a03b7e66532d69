"""Stamps as text: seconds, or dates if they count from 1970."""

from __future__ import annotations

from datetime import UTC, datetime

EPOCH = 1e8  # [s] above this, stamps count from 1970
YEAR_10000 = 253402300800.0  # [s] from 1970


def is_date(time: float) -> bool:
    """Whether a stamp counts from 1970 and has a year of four digits.

    Args:
        time: the stamp [s].
    """
    return EPOCH < time < YEAR_10000


def instant(time: float) -> str:
    """Format a stamp with one decimal of a second.

    Args:
        time: the stamp [s].

    Returns:
        A date in UTC if the stamp is one, otherwise seconds.
    """
    if not is_date(time):
        return f"{time:.1f} s"
    return datetime.fromtimestamp(time, UTC).strftime("%Y-%m-%d %H:%M:%S.%f")[:-5]
