"""`planetary-twin doctor`: is the installation sound?"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import typer

from ._arguments import JsonOption
from ._figures import console_beside, put_figures

if TYPE_CHECKING:
    from ..doctor.finding import Finding

_COLOURS = {"sound": "green", "absent": "yellow", "broken": "red"}


def doctor(
    json_: JsonOption = None,
) -> None:
    """Check the installation part by part, and say how to mend what is missing.

    Exit code 1: a part is broken. Parts that are absent can be done without.

    Example: planetary-twin doctor --json findings.json
    """
    from rich.table import Table
    from rich.text import Text

    console = console_beside(json_)
    with console.status("looking"):
        found = list(_findings())
    table = Table(box=None, pad_edge=False)
    for heading in ("part", "state", "found", "to mend it"):
        table.add_column(heading, overflow="fold")
    for finding in found:
        colour = _COLOURS[finding.state]
        state = Text(finding.state, colour)
        table.add_row(finding.part, state, Text(finding.told), Text(finding.mend))
    console.print(table)
    put_figures([finding._asdict() for finding in found], json_)
    if any(finding.state == "broken" for finding in found):
        raise typer.Exit(1)


def _findings() -> Iterator[Finding]:
    from ..doctor import apart, cache, disk, environment, packages, viewer

    for part in (packages, cache, disk, viewer, environment, apart):
        yield from part.check()
