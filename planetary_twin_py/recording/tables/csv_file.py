"""Reads CSV as loggers and spreadsheets write it.

Separators are commas, semicolons, tabs, or blanks between numbers; a line may end with one. Lines
that start with #, % or // are comments. Numbers may have decimal commas unless commas separate.
Lines of text before the headings, or before numbers without headings, are left out; columns without
headings are named by their numbers, from 1 on.
"""

from __future__ import annotations

import csv
import io
import re
from typing import BinaryIO

import pyarrow as pa
import pyarrow.csv

from ...text.escaping import one_line
from ...units.conversion import is_number

_COMMENT = re.compile(r"^[ \t]*(?:#|%|//).*(?:\r\n?|\n|\Z)", re.MULTILINE)
_LINE_END = re.compile(r"\r\n?|\n|\Z")
_SEPARATORS = ";\t,"
_NUMBER = r"[ ]*[-+]?(?:\d+[.,]?\d*|[.,]\d+)(?:[eE][-+]?\d+)?[ ]*"
_NUMBERS = re.compile(rf"^(?:{_NUMBER}(?:[;\t, ]{_NUMBER})*[;\t,]?)$", re.MULTILINE)
"""A line of numbers alone."""
_LONGEST_LINE = 60  # characters


def read_csv(stream: BinaryIO) -> pa.Table:
    """Read a CSV file.

    Returns:
        The columns as they are named in the headings; columns without a name and a value are left
        out.

    Raises:
        UnicodeDecodeError: it is not in UTF-8.
        ValueError: it has rows of another length.
        pyarrow.ArrowException: it cannot be read for another reason.
    """
    given = stream.read().decode("utf-8-sig")
    text = _from_headings(_without_comments(given))
    heading, body = _split(text)
    separator = _separator(heading)
    heading = _as_wide_as_its_rows(heading, _split(body)[0], separator)
    names = heading.split(separator)
    commas = separator != "," and re.search(r"\d,\d", body) and not re.search(r"\d\.\d", body)
    text = f"{heading}\n{body}"
    try:
        table = pa.csv.read_csv(
            # By name: threads of Arrow that hold an object of Python may abort the interpreter.
            stream.name if text == given else _memory(text),
            parse_options=pa.csv.ParseOptions(delimiter=separator),
            convert_options=pa.csv.ConvertOptions(decimal_point="," if commas else "."),
        )
    except pa.ArrowInvalid:
        _check_rows(text, separator, len(names))
        raise
    empty = {
        k
        for k, name in enumerate(table.column_names)
        if not name.strip() and table.column(k).null_count == len(table)
    }
    return table.select([k for k in range(table.num_columns) if k not in empty])


def _without_comments(text: str) -> str:
    """The text without comments; the last one before numbers is the heading, as NumPy writes it."""
    last, place = "", 0
    while found := _COMMENT.match(text, place):
        last, place = found[0], found.end()
    body = _COMMENT.sub("", text).lstrip("\r\n")
    first, heading = _split(body)[0], last.strip().lstrip("#%/ ")
    separator = _separator(heading)
    numbers = any(map(is_number, first.split(separator)))
    if last and numbers and first.count(separator) == heading.count(separator):
        return f"{heading}\n{body}"
    return body


def _from_headings(text: str) -> str:
    """The text from its headings on, or with numbers of columns as headings; tabs for blanks."""
    first = _NUMBERS.search(text)
    if first is None:
        return text
    row = first[0].strip("\r\n")
    if not any(separator in row for separator in _SEPARATORS) and len(row.split()) > 1:
        text = re.sub(r"(?m)^[ \t]+|[ \t]+$", "", text)
        text = re.sub(r"[ \t]+", "\t", text)
        first = _NUMBERS.search(text)
        assert first is not None  # blanks became tabs
        row = first[0].strip("\r\n")
    separator = next((one for one in _SEPARATORS if one in row), ",")  # commas may be decimal
    width, before = row.count(separator) + 1, text[: first.start()].splitlines()
    cells = [one.rstrip(separator).count(separator) + 1 for one in (*before[:1], row)]
    if len(before) == 1 or (width > 1 and cells[0] == cells[-1] and before):
        return text  # the first line has the headings
    body = text[first.start() :].lstrip("\r\n")
    if before and before[-1].count(separator) + 1 == width:
        return f"{before[-1]}\n{body}"
    return f"{separator.join(str(number + 1) for number in range(width))}\n{body}"


def _split(text: str) -> tuple[str, str]:
    """The first line and the rest."""
    first, rest = _LINE_END.split(text, maxsplit=1)
    return first, rest


def _separator(heading: str) -> str:
    return max(_SEPARATORS, key=heading.count)


def _as_wide_as_its_rows(heading: str, first: str, separator: str) -> str:
    """The heading, which ends with a separator if and only if the first row does."""
    more = first.count(separator) - heading.count(separator)
    if more == 1 and first.endswith(separator):
        return heading + separator
    return heading[:-1] if more == -1 and heading.endswith(separator) else heading


def _memory(text: str) -> pa.BufferReader:
    """The text in memory of Arrow, which no object of Python holds."""
    data = text.encode()
    buffer = pa.allocate_buffer(len(data))
    memoryview(buffer).cast("B")[:] = data
    return pa.BufferReader(buffer)


def _check_rows(text: str, separator: str, width: int) -> None:
    """Raise `ValueError` that names the first row of another length than `width`, if there is one.

    Raises:
        ValueError: there is one.
    """
    rows = filter(None, csv.reader(io.StringIO(text), delimiter=separator))
    try:
        for row, values in enumerate(rows):
            if len(values) != width:
                shown = one_line(separator.join(values), _LONGEST_LINE)
                count = f"{len(values)} value{'' if len(values) == 1 else 's'}"
                raise ValueError(f"row {row}: has {count}, must have {width}: {shown!r}")
    except csv.Error:
        return
