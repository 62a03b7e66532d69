"""Console output of commands, its width, and what shows that a command is at work."""

from __future__ import annotations

import os
import textwrap
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.status import Status

    from .tables import TableConsole

_NO_BREAK = "\u00a0"
_UNLIMITED = 100_000  # characters, wider than any table row


def make_console(stderr: bool = False, markup: bool = True) -> TableConsole:
    """Return a console that fits lines and tables to the terminal, or to COLUMNS.

    In a pipe or a file each row stays on one line, so that it can be searched.

    Args:
        stderr: whether to print to standard error.
        markup: whether Rich markup in strings is interpreted.
    """
    from .tables import TableConsole

    console = TableConsole(stderr=stderr, markup=markup, highlight=False)
    if not (console.file.isatty() or os.environ.get("COLUMNS")):
        console.width = _UNLIMITED
    return console


def busy(activity: str) -> Status:
    """Context that shows an activity with a spinner on stderr, if that is a terminal."""
    return make_console(stderr=True).status(activity)


@contextmanager
def progress(what: str, total: int) -> Iterator[Callable[[int], None]]:
    """Show a progress bar with the remaining time on stderr, if that is a terminal.

    Args:
        what: label of the bar.
        total: number of units of work.

    Yields:
        A function to call with the number of units completed since the last call.
    """
    from rich.progress import MofNCompleteColumn, Progress, TimeRemainingColumn

    columns = (*Progress.get_default_columns()[:2], MofNCompleteColumn(), TimeRemainingColumn())
    console = make_console(stderr=True)
    with Progress(*columns, console=console, disable=not console.is_terminal) as bar:
        task = bar.add_task(what, total=total)
        yield lambda done: bar.advance(task, done)


@contextmanager
def progress_of(what: str) -> Iterator[Callable[[float, float], None]]:
    """Show how far an activity is, with a bar on stderr that disappears, if that is a terminal.

    Args:
        what: label of the bar.

    Yields:
        A function to call with what is done and with the whole, such as two times.
    """
    from rich.progress import Progress

    console = make_console(stderr=True)
    with Progress(console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task(what, total=None)
        yield lambda done, whole: bar.update(task, completed=done, total=whole)


def print_list(console: TableConsole, lead: str, parts: Iterable[str]) -> None:
    """Print parts separated by commas; lines break between parts only, not before a unit.

    Args:
        console: where to print; its width limits the lines.
        lead: text before the first part, with what separates them.
        parts: texts without commas.
    """
    whole = ", ".join(part.replace(" ", _NO_BREAK) for part in parts)
    folded = textwrap.fill(f"{lead}{whole}", console.width, subsequent_indent="  ")
    console.one_line(folded.replace(_NO_BREAK, " "))
