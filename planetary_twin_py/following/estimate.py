"""Results of a follower: estimates with intervals, and events."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

Status = Literal["ESTIMATED", "NOT_IDENTIFIABLE", "LEARNING", "STALE"]
CONFIDENT = 1.96  # standard deviations of a two-sided interval of 95 %


class Estimate(NamedTuple):
    """Estimate of one quantity."""

    name: str
    """Name of the quantity."""
    value: float
    """Value in SI; NaN unless the status is ESTIMATED."""
    sd: float
    """Standard deviation, in SI."""
    low: float
    """Lower end of the 95 % interval, in SI; NaN unless the status is ESTIMATED."""
    high: float
    """Upper end of the interval, in SI; NaN unless the status is ESTIMATED."""
    unit: str
    """SI unit; empty for a dimensionless number."""
    status: Status
    """ESTIMATED; NOT_IDENTIFIABLE from these readings; LEARNING; STALE: readings have ended."""
    remedy: str
    """Readings that would determine it, or determine it better; empty if unknown."""


def estimated(name: str, value: float, sd: float, unit: str, remedy: str = "") -> Estimate:
    """An estimate in SI that the readings determine, with its 95 % interval."""
    reach = CONFIDENT * sd
    return Estimate(name, value, sd, value - reach, value + reach, unit, "ESTIMATED", remedy)


def not_identifiable(
    name: str, sd: float, unit: str, remedy: str, status: Status = "NOT_IDENTIFIABLE"
) -> Estimate:
    """A quantity that the readings do not determine, or not yet; its deviation is in SI."""
    nan = float("nan")
    return Estimate(name, nan, sd, nan, nan, unit, status, remedy)


@dataclass(frozen=True)
class Event:
    """A detected change."""

    what: str
    """Description."""
    since: float
    """Earliest time at which it may have started [s]."""
    found: float
    """Time of the last reading that was needed to detect it [s]."""
    size: Estimate
    """Size of the change."""
    causes: tuple[str, ...]
    """Possible causes; one if the readings determine it."""
    evidence: str
    """Figures that support the detection."""
