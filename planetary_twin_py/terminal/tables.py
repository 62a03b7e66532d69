"""Tables that are readable at any width: no word or number is cut.

The columns of a table that is too wide are narrowed by folding cells between words. If that is not
enough, each row becomes a paragraph that starts with its first cell.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import Any

from rich.console import Console, ConsoleOptions, Group, RenderableType, RenderResult
from rich.markup import escape
from rich.measure import measure_renderables
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from ..text.escaping import printable

_INDENT = 4
_UNLIMITED = 100_000  # characters, wider than any table


def table(
    headings: Iterable[str],
    rows: Iterable[Sequence[str | Text]] = (),
    *,
    title: str | None = None,
    caption: str | None = None,
    texts: Collection[str] = (),
    whole: bool = False,
    framed: bool = True,
) -> Table:
    """Make a table of a column of names, and columns of figures.

    Args:
        headings: of the columns, plain text.
        rows: cells, with Rich markup.
        title: above the table, with Rich markup.
        caption: below the table, with Rich markup.
        texts: headings of further columns that are not figures, so not aligned to the right.
        whole: whether no cell is folded, except in columns of texts.
        framed: whether lines separate the columns.
    """
    made = Table(title=title, caption=caption)
    if not framed:
        made.box, made.pad_edge = None, False
    for place, heading in enumerate(headings):
        is_text = heading in texts or (place == 0 and not texts)
        made.add_column(
            escape(heading),
            justify="left" if is_text else "right",
            no_wrap=whole and not is_text,
        )
    for row in rows:
        made.add_row(*row)
    return made


class TableConsole(Console):
    """A console that formats tables with `readable`."""

    def print(self, *objects: Any, **how: Any) -> None:
        """Print as Rich does; tables fit the width, and control characters are escaped."""
        super().print(*(self._escaped(one) for one in objects), **how)

    def one_line(self, text: str) -> None:
        """Print plain text as one line, which the terminal folds where it is too long."""
        self.print(text, markup=False, soft_wrap=True)

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
    wide = console.options.update(width=_UNLIMITED, max_width=_UNLIMITED)
    sizes = [
        measure_renderables(console, wide, (column.header, *column.cells))
        for column in table.columns
    ]
    wanted = [size.maximum for size in sizes]
    needed = [
        size.maximum if column.no_wrap else size.minimum  # of the longest word
        for column, size in zip(table.columns, sizes, strict=True)
    ]
    frame = console.measure(table, options=wide).maximum - sum(wanted)
    room = console.width - frame
    if sum(wanted) <= room:
        return table
    if sum(needed) > room:
        return Group(*_paragraphs(table, console))
    share = (room - sum(needed)) / (sum(wanted) - sum(needed))
    for column, least, most in zip(table.columns, needed, wanted, strict=True):
        column.width = least + int(share * (most - least))
    return table


def _paragraphs(table: Table, console: Console) -> Iterator[RenderableType]:
    """Title; for each row its first cell, then the other cells with their headings; caption."""

    def text(cell: RenderableType) -> Text:
        return cell if isinstance(cell, Text) else console.render_str(str(cell), highlight=False)

    if table.title:
        yield table.title
    headings = [" ".join(text(column.header).plain.split()) for column in table.columns]
    cells_by_row = zip(*(map(text, column.cells) for column in table.columns), strict=True)
    for row, cells in zip(table.rows, cells_by_row, strict=True):
        style = row.style or ""
        yield Text.assemble(cells[0], style=style)
        others = zip(headings[1:], cells[1:], strict=True)
        pieces = [Text.assemble(f"{name}: " if name else "", cell) for name, cell in others if cell]
        yield Padding(Text("; ", style=style).join(pieces), (0, 0, 0, _INDENT))
    if table.caption:
        yield table.caption
