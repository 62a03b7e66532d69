"""What a follower says: estimates with intervals, and events."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

Status = Literal["ESTIMATED", "NOT_IDENTIFIABLE", "LEARNING", "STALE"]
CONFIDENT = 1.96  # standard deviations of a two-sided interval of 95 %


class Estimate(NamedTuple):
    """One quantity."""

    name: str
    """Of the quantity."""
    value: float
    """In SI; NaN unless the status is ESTIMATED."""
    sd: float
    """Standard deviation, in SI."""
    low: float
    """Low end of the 95 % interval, in SI; NaN unless the status is ESTIMATED."""
    high: float
    """High end, likewise."""
    unit: str
    """SI unit; empty for a dimensionless number."""
    status: Status
    """ESTIMATED; NOT_IDENTIFIABLE from these readings; LEARNING; STALE: no readings any more."""
    remedy: str
    """What would tell it, or tell it better; empty if that is not known."""


def estimated(name: str, value: float, sd: float, unit: str, remedy: str = "") -> Estimate:
    """An estimate that the readings determine.

    Args:
        name: of the quantity.
        value: in SI.
        sd: standard deviation, in SI.
        unit: SI unit.
        remedy: what would tell it better.
    """
    reach = CONFIDENT * sd
    return Estimate(name, value, sd, value - reach, value + reach, unit, "ESTIMATED", remedy)


def not_identifiable(
    name: str, sd: float, unit: str, remedy: str, status: Status = "NOT_IDENTIFIABLE"
) -> Estimate:
    """A quantity that the readings do not determine, or not yet.

    Args:
        name: of the quantity.
        sd: standard deviation that is left, in SI.
        unit: SI unit.
        remedy: what would tell it.
        status: NOT_IDENTIFIABLE, LEARNING or STALE.
    """
    nan = float("nan")
    return Estimate(name, nan, sd, nan, nan, unit, status, remedy)


@dataclass(frozen=True)
class Event:
    """A change that was found."""

    what: str
    """In words."""
    since: float
    """Earliest time at which it may have started [s]."""
    found: float
    """Time of the last reading that was needed [s]."""
    size: Estimate
    """How much."""
    causes: tuple[str, ...]
    """What may have caused it; one where the readings tell."""
    evidence: str
    """Figures that support it."""
