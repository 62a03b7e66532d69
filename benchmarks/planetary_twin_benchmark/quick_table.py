"""The table of `bench --quick`, for a terminal and for a page such as the README."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

from rich.table import Table

from .machine import code, machine
from .markdown import markdown_table, three_digits
from .quick import Quick, peers_installed
from .timing import Speed

TITLES = (
    "case", "times real time, every cycle", "error of DTE", "over a minute", "error of DTE",
    "times CVODE", "with samples",
)  # fmt: skip


def quick_table(rows: Sequence[Quick]) -> Table:
    """Table for the terminal."""
    found = [speed for row in rows for speed in _speeds(row) if not math.isnan(speed.median)]
    spread = max((speed.high - speed.low) / speed.median for speed in found)
    lines = [f"medians; the slowest and the fastest round differ by {spread:.0%} at most"]
    if not peers_installed():
        lines += ["times CVODE needs scikit-sundae: pip install 'planetary_twin_py[bench]'"]
    table = Table(
        box=None, header_style="bold", pad_edge=False, caption="\n".join(lines),
        title=f"{code()}, {machine()}", title_justify="left", caption_justify="left",
    )  # fmt: skip
    for title in TITLES:
        table.add_column(title, justify="left" if title == "case" else "right")
    for row in rows:
        table.add_row(*_cells(row))
    return table


def into_page(page: str, rows: Sequence[Quick]) -> str:
    """A page of Markdown with the table: in place of that of the same code, below those of other
    code, or at the end.
    """
    table = markdown_table(TITLES, [_cells(row) for row in rows])
    new = f"**{code()}**, {machine()}:\n\n{table}\n"
    found = list(re.finditer(r"^\*\*(.+ code .+)\*\*.*\n\n(?:\|.*\n)+", page, re.MULTILINE))
    for block in found:
        if block[1] == code():
            return page[: block.start()] + new + page[block.end() :]
    end = found[-1].end() if found else len(page)
    return page[:end] + ("\n" if page else "") + new + page[end:]


def _speeds(row: Quick) -> tuple[Speed, ...]:
    first = row.rows[0]
    every = Speed(first.rtf, first.rtf_low, first.rtf_high)
    return every, row.minute.speed, row.ratio, row.sampled_ratio


def _cells(row: Quick) -> tuple[str, ...]:
    first = row.rows[0]
    every, minute, *ratios = (_figure(speed.median) for speed in _speeds(row))
    minute_error = _error(row.minute.error_dte)
    return first.case, every, _error(first.error_dte), minute, minute_error, *ratios


def _figure(speed: float) -> str:
    return "-" if math.isnan(speed) else three_digits(speed)


def _error(error: float) -> str:
    return "-" if math.isnan(error) else f"{error:.1e}"
