"""Sizes that the pages of a Parquet file state, which may contradict those of its metadata.

Arrow allocates a page by the size in the page's own header. Headers are Thrift structures in the
compact protocol (Apache Parquet format, `PageHeader`).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import BinaryIO, NamedTuple

from pyarrow import parquet

MOST_PAGES = 100_000  # writers make pages of 0.1 to 1 MB
_HEADERS = 2**12, 2**24  # bytes that are read for a header; the second if statistics are long
_DEEPEST = 8  # nested structures
_STOP, _TRUE, _FALSE, _BYTE, _I16, _I32, _I64, _DOUBLE, _BINARY, _LIST, _SET, _MAP, _STRUCT = range(
    13
)
_WHOLE = (_I16, _I32, _I64)
_UNPACKED, _PACKED = 2, 3  # numbers of the fields


class PageError(ValueError):
    """The pages of a file cannot be read."""


class Page(NamedTuple):
    """Sizes in the header of a page."""

    header: int
    """Size of the header itself [B]."""
    packed: int
    """Size in the file [B]."""
    unpacked: int
    """Size in memory [B]."""


def unpacked_size(stream: BinaryIO, metadata: parquet.FileMetaData) -> int:
    """Size of all pages in memory, by their headers.

    Args:
        stream: the file.
        metadata: metadata of the file.

    Returns:
        The size [B].

    Raises:
        PageError: a header cannot be read, or there are too many pages.
    """
    groups = (metadata.row_group(k) for k in range(metadata.num_row_groups))
    columns = (group.column(k) for group in groups for k in range(group.num_columns))
    total = 0
    for number, page in enumerate(page for column in columns for page in _pages(stream, column)):
        if number >= MOST_PAGES:
            raise PageError(f"has more than {MOST_PAGES} pages")
        total += page.unpacked
    return total


def _pages(stream: BinaryIO, column: parquet.ColumnChunkMetaData) -> Iterator[Page]:
    """Pages of a column in one row group, as Arrow finds them."""
    begin = column.data_page_offset
    if column.has_dictionary_page and 0 < column.dictionary_page_offset < begin:
        begin = column.dictionary_page_offset
    place, end = begin, begin + column.total_compressed_size
    while 0 <= place < end:
        page = _page_at(stream, place, end)
        yield page
        place += page.header + page.packed


def _page_at(stream: BinaryIO, place: int, end: int) -> Page:
    """The page at a position, whose header ends before another."""
    short, long = (min(length, end - place) for length in _HEADERS)
    stream.seek(place)
    data = stream.read(short)
    try:
        return read_page(data)
    except PageError:
        if short == long:
            raise
        return read_page(data + stream.read(long - short))


def read_page(data: bytes) -> Page:
    """Read the header of a page.

    Args:
        data: bytes that begin with the header.

    Returns:
        Its sizes.

    Raises:
        PageError: it is not a header, or it has no sizes.
    """
    reader = _Reader(data)
    try:
        fields = reader.fields()
        page = Page(reader.place, fields[_PACKED], fields[_UNPACKED])
    except (IndexError, KeyError) as reason:
        raise PageError("the header of a page is damaged") from reason
    if min(page.packed, page.unpacked) < 0:
        raise PageError(f"a page states {min(page.packed, page.unpacked)} bytes")
    return page


class _Reader:
    """Reads the whole numbers of a structure, and skips the rest of it."""

    def __init__(self, data: bytes) -> None:
        self.place = 0
        self._data = data

    def fields(self, depth: int = 0) -> dict[int, int]:
        """Whole numbers of the structure that begins here, by field."""
        if depth > _DEEPEST:
            raise PageError("the header of a page has too many levels")
        values: dict[int, int] = {}
        number = 0
        while head := self._byte():
            kind, step = head & 15, head >> 4
            number = number + step if step else self._signed()
            if kind in _WHOLE:
                values[number] = self._signed()
            else:
                self._skip(kind, depth)
        return values

    def _skip(self, kind: int, depth: int) -> None:
        if kind in (_TRUE, _FALSE):  # the value is the kind
            return
        if kind == _STRUCT:
            self.fields(depth + 1)
        elif kind in _WHOLE:
            self._varint()
        elif kind in (_BYTE, _DOUBLE):
            self.place += 1 if kind == _BYTE else 8
        elif kind == _BINARY:
            length = self._varint()
            self.place += length
        elif kind in (_LIST, _SET):
            self._skip_list(depth)
        else:
            raise PageError(f"the header of a page has a field of kind {kind}")

    def _skip_list(self, depth: int) -> None:
        head = self._byte()
        count = head >> 4 if head >> 4 < 15 else self._varint()
        for _ in range(min(count, len(self._data))):
            self._byte() if head & 15 in (_TRUE, _FALSE) else self._skip(head & 15, depth + 1)

    def _byte(self) -> int:
        self.place += 1
        return self._data[self.place - 1]

    def _varint(self) -> int:
        value, shift = 0, 0
        while True:
            byte = self._byte()
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return value
            if shift > 63:
                raise PageError("the header of a page has a number of more than 64 bits")

    def _signed(self) -> int:
        value = self._varint()
        return (value >> 1) ^ -(value & 1)
