"""Results of `planetary-twin follow`: a table and lines, and figures for `--json`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from ..terminal.messages import warn
from ..terminal.names import shown
from ..text.finite import finite
from ..text.intervals import interval_text
from ..text.stamps import instant, is_date
from ..units.engineering import percent

if TYPE_CHECKING:
    from ..following.state import Following
    from ..terminal.tables import TableConsole

REMEDY = "improved by"
"""Heading of the column with readings that would determine a quantity, or determine it better."""


def print_state(
    console: TableConsole, name: str, span: tuple[float, float], state: Following
) -> None:
    """Print estimates, events, teeth and warnings.

    Args:
        console: console to print on.
        name: name of the scene.
        span: first and last stamp of the readings [s].
        state: estimated state after the last reading.
    """
    from ..terminal.tables import table

    rows = []
    for one in state.estimates:
        known = one.status in ("ESTIMATED", "STALE")
        value, interval = interval_text(one.value, one.low, one.high) if known else ("-", "-")
        status = one.status.replace("_", " ")
        rows.append([one.name, value, interval, one.unit or "-", status, one.remedy])
    headings = ("quantity", "estimate", "95 % interval", "unit", "status", REMEDY)
    title = f"{shown(name)}, {_span(*span)}"
    console.print(table(headings, rows, title=title, texts=(REMEDY,)))
    for line in _lines(state):
        console.one_line(line)
    warn(state.remarks)


def _span(first: float, last: float) -> str:
    """Format the first and the last stamp: seconds with two decimals, or dates."""
    if is_date(first) and is_date(last):
        return f"{instant(first)} to {instant(last)}"
    return f"{first:.2f} to {last:.2f} s"


def _lines(state: Following) -> Iterator[str]:
    """Events and teeth, one line each."""
    if not state.events:
        yield state.unchanged
    for event in state.events:
        causes = f"; {' or '.join(event.causes)}" if event.causes else ""
        since = f"since {instant(event.since)}, found at {instant(event.found)}"
        yield f"{event.what}: {event.evidence}; {since}{causes}"
    for tooth in state.teeth:
        loss = tooth.loss
        size = (
            f"as a crack {percent(loss.low).removesuffix(' %')} to {percent(loss.high)} of "
            "stiffness lost"
            if loss.status == "ESTIMATED"
            else f"its size follows from {loss.remedy}"
        )
        kinds = " or ".join(tooth.kinds)
        name = f"{tooth.gear} tooth {tooth.tooth}"
        yield f"{name}: {kinds}, {size}, z = {tooth.z:.1f}{tooth.as_likely}"


def state_figures(state: Following) -> dict[str, Any]:
    """Results for `--json`.

    Args:
        state: estimated state.

    Returns:
        Estimates, events, teeth, counters and remarks.
    """
    return {
        "time": finite(state.time),
        "estimates": {
            one.name: {key: finite(value) for key, value in one._asdict().items() if key != "name"}
            for one in state.estimates
        },
        "events": [
            {
                name: getattr(event, name)
                for name in ("what", "since", "found", "causes", "evidence")
            }
            | {"size": {key: finite(value) for key, value in event.size._asdict().items()}}
            for event in state.events
        ],
        "teeth": [
            {
                "gear": tooth.gear,
                "tooth": tooth.tooth,
                "stiffness_loss": finite(tooth.loss.value),
                "low": finite(tooth.loss.low),
                "high": finite(tooth.loss.high),
                "z": tooth.z,
                "kinds": tooth.kinds,
                "candidates": tooth.candidates,
            }
            for tooth in state.teeth
        ],
        "judged": dict(state.judged),
        "counters": state.counters,
        "remarks": state.remarks,
    }
