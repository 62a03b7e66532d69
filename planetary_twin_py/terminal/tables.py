"""Tables that are readable at any width: no word or number is cut.

The columns of a table that is too wide are narrowed by folding cells between words. If that is not
enough, each row becomes a paragraph that starts with its first cell.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from rich.console import Console, ConsoleOptions, Group, RenderableType, RenderResult
from rich.measure import Measurement
from rich.padding import Padding
from rich.table import Column, Table
from rich.text import Text

from ..text.escaping import printable

_INDENT = 4
_UNLIMITED = 100_000  # characters, wider than any table


class TableConsole(Console):
    """A console that formats tables with `readable`."""

    def print(self, *objects: Any, **how: Any) -> None:
        """Print as Rich does; tables fit the width, and control characters are escaped."""
        super().print(*(self._escaped(one) for one in objects), **how)

    def _escaped(self, shown: Any) -> Any:
        if isinstance(shown, str):
            return printable(shown)
        return _Escaped(readable(shown, self) if isinstance(shown, Table) else shown)


class _Escaped:
    """A Rich renderable with control characters escaped; names from a file may contain them."""

    def __init__(self, shown: Any) -> None:
        self._shown = shown

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        for segment in console.render(self._shown, options):
            yield segment if segment.control else segment._replace(text=printable(segment.text))


def readable(table: Table, console: Console) -> RenderableType:
    """Fit a table to the width of `console`.

    Args:
        table: a table whose headings and cells are texts.
        console: where the table is to be printed.

    Returns:
        The table with narrower columns, or, if the words do not fit, a paragraph per row.
    """
    columns = [_texts(column, console) for column in table.columns]
    wanted = [_longest(texts, by_word=False) for texts in columns]
    needed = [
        most if column.no_wrap else _longest(texts, by_word=True)
        for column, texts, most in zip(table.columns, columns, wanted, strict=True)
    ]
    wide = console.options.update(width=_UNLIMITED, max_width=_UNLIMITED)
    frame = Measurement.get(console, wide, table).maximum - sum(wanted)
    room = console.width - frame
    if sum(wanted) <= room:
        return table
    if sum(needed) > room:
        return Group(*_entries(table, columns))
    share = (room - sum(needed)) / (sum(wanted) - sum(needed))
    for column, least, most in zip(table.columns, needed, wanted, strict=True):
        column.width = least + int(share * (most - least))
    return table


def _texts(column: Column, console: Console) -> list[Text]:
    """Heading and cells of a column, as `console` prints them."""
    return [
        cell if isinstance(cell, Text) else console.render_str(str(cell), highlight=False)
        for cell in (column.header, *column.cells)
    ]


def _longest(texts: list[Text], by_word: bool) -> int:
    """Width, in character cells, of the longest line or of the longest word."""
    parts = (text.plain.split() if by_word else text.plain.splitlines() for text in texts)
    return max((Text(part).cell_len for own in parts for part in own), default=0)


def _entries(table: Table, columns: list[list[Text]]) -> Iterator[RenderableType]:
    """Title; for each row its first cell, then the other cells with their headings; caption."""
    if table.title:
        yield table.title
    headings = [" ".join(texts[0].plain.split()) for texts in columns]
    cells_by_row = zip(*(texts[1:] for texts in columns), strict=True)
    for row, cells in zip(table.rows, cells_by_row, strict=True):
        style = row.style or ""
        yield Text.assemble(cells[0], style=style)
        others = zip(headings[1:], cells[1:], strict=True)
        pieces = [Text.assemble(f"{name}: " if name else "", cell) for name, cell in others if cell]
        yield Padding(Text("; ", style=style).join(pieces), (0, 0, 0, _INDENT))
    if table.caption:
        yield table.caption
