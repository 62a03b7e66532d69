"""Names of a file and of its column in the text of an option."""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

from ..container.suffixes import is_table

_FILE = re.compile(r"(?P<file>.+?\.\w+)(?::(?P<column>.+))?", re.DOTALL)


class Source(NamedTuple):
    """A column, perhaps of another file."""

    file: Path
    column: str | None
    """None if the file has only one."""


def source_of(text: str, file: Path) -> Source:
    """The column that the text of an option names.

    Args:
        text: `COLUMN` of `file`, `FILE:COLUMN`, or `FILE` with one column.
        file: of the samples.
    """
    parts = _FILE.fullmatch(text)
    if parts is not None:
        other = Path(parts["file"])
        if is_table(other) or other.suffix.lower() in (".npz", ".mcap"):
            return Source(other, parts["column"])
    return Source(file, text)
