"""Tolerances of a run."""

from __future__ import annotations

from collections.abc import Sequence

from ..text.number_check import check_number

TOLERANCES = (1e-8, 0.1)  # allowed range
LADDER = (1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6)
"""Tolerances for automatic selection, the loosest first."""
AUTOMATIC = 0.0
"""In place of a tolerance: automatic selection from `LADDER`."""
LIVE_TOLERANCE = 3e-3  # default for live twins, on a machine of unknown speed


def check_tolerance(tolerance: float) -> None:
    """Raise `ValueError` if a tolerance is out of range."""
    check_number("tolerance", tolerance)
    if not TOLERANCES[0] <= tolerance <= TOLERANCES[1]:
        raise ValueError(
            f"tolerance = {tolerance!r}: must be within {TOLERANCES[0]:g} and {TOLERANCES[1]:g}"
        )


def ladder_of(tolerance: float) -> Sequence[float]:
    """Tolerances to select from: only `tolerance`, or all of `LADDER` if it is AUTOMATIC.

    Raises:
        ValueError: `tolerance` is neither AUTOMATIC nor in range.
    """
    if tolerance == AUTOMATIC:
        return LADDER
    try:
        check_tolerance(tolerance)
    except ValueError as refusal:
        raise ValueError(f"{refusal}, or {AUTOMATIC:g} for automatic") from None
    return (tolerance,)
