"""Where a command prints for a person, and how wide."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console

_ENDLESS = 100_000  # characters: more than any row of a table has


def make_console(stderr: bool = False, markup: bool = True) -> Console:
    """Return a console that folds lines for a terminal, or to the COLUMNS that are asked for.

    In a pipe or a file a row stays one line, so that it can be searched for.
    """
    from rich.console import Console

    console = Console(stderr=stderr, markup=markup)
    if not (console.file.isatty() or os.environ.get("COLUMNS")):
        console.width = _ENDLESS
    return console
