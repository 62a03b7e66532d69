"""Part of the measurements that `planetary-twin fit` uses, and its results."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from ..text.finite import finite
from ..text.intervals import interval_text

if TYPE_CHECKING:
    from rich.console import Console

    from ..plots.fit_report import Report
    from ..studies.fit.estimate import Estimate
    from ..studies.fit.parameter import Parameter


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


def print_fit(
    console: Console,
    title: str,
    parameters: Sequence[Parameter],
    estimate: Estimate,
    confidence: float,
    sources: Sequence[str] = (),
) -> None:
    """Print a table of the estimates.

    Args:
        console: console to print on.
        title: of the table.
        parameters: the free parameters.
        estimate: their estimates.
        confidence: level of the intervals.
        sources: where each interval comes from; empty: no such column.
    """
    from rich.table import Table

    table = Table(title=title)
    headings = ["field", "estimate", f"{100.0 * confidence:g} % interval", "unit"]
    for heading in [*headings, *(["from"] if sources else [])]:
        table.add_column(heading, justify="right")
    for k, parameter in enumerate(parameters):
        low, high, _ = estimate.intervals[k]
        value, span = interval_text(estimate.values[k], low, high)
        shown_value = value if estimate.identifiable(k) else "not identifiable"
        table.add_row(parameter.name, shown_value, span, parameter.unit, *sources[k : k + 1])
    console.print(table)


def parameter_figures(
    parameters: Sequence[Parameter], estimate: Estimate
) -> dict[str, dict[str, Any]]:
    """Estimates for `--json`, by name of the parameter.

    Args:
        parameters: the free parameters.
        estimate: their estimates.
    """
    return {
        p.name: {
            "estimate": float(estimate.values[k]) if estimate.identifiable(k) else None,
            "low": finite(estimate.intervals[k].low),
            "high": finite(estimate.intervals[k].high),
            "unit": p.unit,
            "identifiable": estimate.identifiable(k),
            "at_bound": estimate.at_bound[k],
        }
        for k, p in enumerate(parameters)
    }
