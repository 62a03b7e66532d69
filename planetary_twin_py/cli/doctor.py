"""`planetary-twin doctor`: checks of the installation."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import typer

from ..terminal.arguments import JsonOption
from ..terminal.json_output import console_beside, write_json

if TYPE_CHECKING:
    from ..doctor.finding import Finding

_COLOURS = {"sound": "green", "absent": "yellow", "broken": "red"}


def doctor(
    json_: JsonOption = None,
) -> None:
    """Check each part of the installation, and say how to fix what is missing or broken.

    The exit code is 1 if a part is broken. Parts that are absent are optional.

    Example: planetary-twin doctor --json findings.json
    """
    from rich.text import Text

    from ..terminal.tables import table

    console = console_beside(json_)
    with console.status("checking the installation"):
        found = list(_findings())
    rows: list[list[str | Text]] = [
        [
            each.part,
            Text(each.state, _COLOURS[each.state]),
            Text(each.details),
            Text(each.fix),
        ]
        for each in found
    ]
    headings = ("part", "state", "details", "fix")
    console.print(table(headings, rows, texts=headings, framed=False))
    write_json([_as_figures(finding) for finding in found], json_)
    if any(finding.state == "broken" for finding in found):
        raise typer.Exit(1)


def _as_figures(finding: Finding) -> dict[str, str]:
    """The fields of a finding; the keys "told" and "mend" are deprecated."""
    return finding._asdict() | {"told": finding.details, "mend": finding.fix}


def _findings() -> Iterator[Finding]:
    from ..doctor import apart, core, disk, environment, packages, viewer

    for part in (packages, core, disk, viewer, environment, apart):
        yield from part.check()
