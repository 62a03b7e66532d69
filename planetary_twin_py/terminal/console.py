"""Console output of commands, and its width."""

from __future__ import annotations

import os
import textwrap
from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console
    from rich.status import Status

_NO_BREAK = "\u00a0"
_UNLIMITED = 100_000  # characters, wider than any table row


def make_console(stderr: bool = False, markup: bool = True) -> Console:
    """Return a console that fits lines and tables to the terminal, or to COLUMNS.

    In a pipe or a file each row stays on one line, so that it can be searched.

    Args:
        stderr: whether to print to standard error.
        markup: whether Rich markup in strings is interpreted.
    """
    from .tables import TableConsole

    console = TableConsole(stderr=stderr, markup=markup)
    if not (console.file.isatty() or os.environ.get("COLUMNS")):
        console.width = _UNLIMITED
    return console


def busy(activity: str) -> Status:
    """Context that shows an activity with a spinner on stderr, if that is a terminal."""
    return make_console(stderr=True).status(activity)


def print_list(console: Console, lead: str, parts: Iterable[str]) -> None:
    """Print parts separated by commas; lines break between parts only, not before a unit.

    Args:
        console: where to print; its width limits the lines.
        lead: text before the first part, with what separates them.
        parts: texts without commas.
    """
    whole = ", ".join(part.replace(" ", _NO_BREAK) for part in parts)
    folded = textwrap.fill(f"{lead}{whole}", console.width, subsequent_indent="  ")
    console.print(folded.replace(_NO_BREAK, " "), markup=False, highlight=False, soft_wrap=True)
