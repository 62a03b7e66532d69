"""Results of following a plant: a table and lines, or JSON values."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planetary_twin_msgs.msg import FollowerEstimate, FollowerEvent, FollowerTeeth
from rich.console import Console
from rich.table import Table

from planetary_twin_py.following.channels.stamp import seconds, stamp_of
from planetary_twin_py.recording.ros2.definitions import definition_of
from planetary_twin_py.recording.ros2.message_units import units_of
from planetary_twin_py.text.finite import finite

from ..follower.messages import QUANTITIES

_HEADINGS = "quantity", "estimate", "95 % interval", "unit", "status", "improved by"


@dataclass(frozen=True)
class Followed:
    """
    Results of a finished run.

    `begin` is the stamp of the first reading [s], `condition` the last report on the condition,
    which says what it means that there are no changes.
    """

    folder: Path
    begin: float
    estimate: FollowerEstimate
    teeth: FollowerTeeth | None
    events: Sequence[FollowerEvent]
    condition: str

    def figures(self) -> dict[str, Any]:
        """Return the values for `--json`; times are since the first reading."""
        return {
            "recording": str(self.folder),
            "estimates": {
                name: {
                    "value": finite(getattr(self.estimate, name)),
                    **{
                        part: finite(getattr(self.estimate, f"{name}_{part}"))
                        for part in ("sd", "low", "high", "status", "remedy")
                    },
                }
                for name in QUANTITIES
            },
            "events": [
                {
                    "what": event.what,
                    "found": stamp_of(event) - self.begin,
                    "since": seconds(event.since) - self.begin,
                    "size": finite(event.size),
                    "low": finite(event.size_low),
                    "high": finite(event.size_high),
                    "unit": event.unit,
                    "causes": list(event.causes),
                }
                for event in self.events
            ],
            "teeth": [] if self.teeth is None else list(self.teeth.changed),
            "condition": self.condition,
        }


def event_line(event: FollowerEvent, begin: float) -> str:
    """Return an event as a line, with times since `begin` [s]."""
    causes = f"; {' or '.join(event.causes)}" if event.causes else ""
    since, found = (seconds(stamp) - begin for stamp in (event.since, event.header.stamp))
    return f"{event.what}: {event.evidence}; since {since:.1f} s, found at {found:.1f} s{causes}"


def print_followed(console: Console, followed: Followed) -> None:
    """Print estimates and changes."""
    table = Table(title=f"{stamp_of(followed.estimate) - followed.begin:.1f} s")
    for heading in _HEADINGS:
        table.add_column(heading, justify="left" if heading == _HEADINGS[-1] else "right")
    for row in _rows(followed.estimate):
        table.add_row(*row)
    console.print(table)
    lines = [event_line(event, followed.begin) for event in followed.events]
    for line in (*(lines or [followed.condition]), f"recording  {followed.folder}"):
        console.print(line, highlight=False, markup=False, soft_wrap=True)


def _rows(estimate: FollowerEstimate) -> Iterator[tuple[str, ...]]:
    units = units_of(definition_of("planetary_twin_msgs/msg/FollowerEstimate"))
    for name in QUANTITIES:
        value, low, high = (getattr(estimate, f"{name}{end}") for end in ("", "_low", "_high"))
        known = math.isfinite(value)
        status = getattr(estimate, f"{name}_status")
        if status:
            yield (
                name,
                f"{value:.4g}" if known else "-",
                f"{low:.4g} to {high:.4g}" if known else "-",
                units[name],
                status.replace("_", " "),
                getattr(estimate, f"{name}_remedy"),
            )
