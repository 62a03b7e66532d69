"""Part of the measurements that `planetary-twin fit` uses, and its results."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from ..plots.fit_report import Report


class Part(NamedTuple):
    """Parts of the measurements that are fitted and predicted."""

    begin: float | None
    """Start of the fitted part [s]; None: default of the kind of measurement."""
    end: float | None
    """End of the fitted part [s]."""
    hold_out: tuple[float, float] | None
    """Start and end of another part [s], which is predicted and not fitted."""


class Fitted(NamedTuple):
    """Results of a fit, which are printed already."""

    figures: dict[str, Any]
    """For --json."""
    report: Callable[[], Report]
    """Makes the report, with its pictures."""
