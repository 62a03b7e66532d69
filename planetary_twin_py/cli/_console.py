"""Where a command prints for a person, and how wide."""

from __future__ import annotations

import os
import textwrap
from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console

_NO_BREAK = "\u00a0"
_ENDLESS = 100_000  # characters: more than any row of a table has


def make_console(stderr: bool = False, markup: bool = True) -> Console:
    """Return a console that fits lines and tables to a terminal, or to the COLUMNS asked for.

    In a pipe or a file a row stays one line, so that it can be searched for.
    """
    from ._tables import TableConsole

    console = TableConsole(stderr=stderr, markup=markup)
    if not (console.file.isatty() or os.environ.get("COLUMNS")):
        console.width = _ENDLESS
    return console


def put_together(console: Console, title: str, parts: Iterable[str]) -> None:
    """Print parts one after another, folded between them only, so that units stay with values.

    Args:
        console: where to print, and how wide.
        title: stands before them.
        parts: texts without commas.
    """
    whole = ", ".join(part.replace(" ", _NO_BREAK) for part in parts)
    folded = textwrap.fill(f"{title}: {whole}", console.width, subsequent_indent="  ")
    console.print(folded.replace(_NO_BREAK, " "), markup=False, highlight=False, soft_wrap=True)
