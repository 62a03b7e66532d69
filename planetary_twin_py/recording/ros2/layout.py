"""Byte layout of serialised messages (CDR), so that many messages are read as one array.

The positions of fields depend only on the definition and on the lengths of strings and sequences.
Messages with equal lengths are therefore rows of one structured array.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import groupby
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rosbags.interfaces import Nodetype

Fields = Iterable[tuple[str, Any]]
Definitions = Mapping[str, tuple[Any, Fields]]
"""Constants and fields by the name of a type, as rosbags parses a definition."""
_Field = tuple[str, Any, int]  # name, format, position
_ENCAPSULATION = 4  # bytes before the body, to whose start alignment refers
_PADDING = 3  # bytes after the last field that pad a message to whole words
_NUMBERS = {"bool": "?", "byte": "u1", "char": "u1", "float32": "f4", "float64": "f8"} | {
    f"{name}{8 * size}": f"{letter}{size}"
    for name, letter in (("int", "i"), ("uint", "u"))
    for size in (1, 2, 4, 8)
}


class LayoutError(ValueError):
    """Bytes are not a message of their type."""


class Layout:
    """Layout of all messages with the same lengths as a given one.

    `dtype`: text is bytes; a nested message is a structure, and an array of texts or messages is a
    structure with fields "0", "1", ...
    """

    def __init__(self, definitions: Definitions, kind: str, message: bytes) -> None:
        """Determine the layout of `message` of type `kind`.

        Raises:
            LayoutError: the message is too short or too long, or not plain CDR.
        """
        walk = _Walk(definitions, message)
        self.dtype = walk.whole(kind)
        self._places = np.array(walk.decisive)
        self._decisive = np.frombuffer(message, np.uint8)[self._places]

    def fits(self, raw: NDArray[np.uint8]) -> NDArray[np.bool_]:
        """Which rows of `raw` (messages, bytes), of this length, have this layout."""
        return np.asarray((raw[:, self._places] == self._decisive).all(axis=1))


class Layouts:
    """The layouts of messages of one type."""

    def __init__(self, definitions: Definitions, kind: str) -> None:
        self._definitions, self._kind = definitions, kind
        self._known: dict[int, list[Layout]] = {}

    def arrays(self, messages: Sequence[bytes]) -> Iterator[NDArray[Any]]:
        """All messages in order: a structured array for each sequence with the same layout.

        Raises:
            LayoutError: one is not a message of this type.
        """
        for size, group in groupby(messages, len):
            raw = np.frombuffer(b"".join(group), np.uint8).reshape(-1, size)
            while len(raw):
                layout = self._layout(raw[:1])
                fits = layout.fits(raw)
                count = len(raw) if fits.all() else int(np.argmin(fits))
                yield raw[:count].view(layout.dtype)[:, 0]
                raw = raw[count:]

    def _layout(self, raw: NDArray[np.uint8]) -> Layout:
        known = self._known.setdefault(raw.shape[1], [])
        for layout in known:
            if layout.fits(raw)[0]:
                return layout
        known.append(Layout(self._definitions, self._kind, raw.tobytes()))
        return known[-1]


class _Walk:
    """Walks through one message; `decisive` are the bytes that determine the layout."""

    def __init__(self, definitions: Definitions, message: bytes) -> None:
        if message[:2] not in (b"\0\0", b"\0\1"):
            raise LayoutError(f"starts with {message[:2].hex() or 'no bytes'}, must be plain CDR")
        self._definitions, self._message = definitions, message
        self._order = "<" if message[1] else ">"
        self._place = _ENCAPSULATION
        self.decisive = [0, 1]
        self._path: list[str] = []  # names of the current field and of its parents

    def whole(self, kind: str) -> np.dtype[Any]:
        """The message, from its encapsulation to its last byte."""
        fields = self._fields(kind)
        excess = len(self._message) - self._place
        if excess > _PADDING:
            raise LayoutError(f"has {excess} bytes after the last field of {kind}")
        return self._structure(fields, 0, len(self._message))

    def _fields(self, kind: str) -> list[_Field]:
        fields: list[_Field] = []
        for name, description in self._definitions[kind][1]:
            self._path.append(name)
            fields.append((name, *self._field(description)))
            self._path.pop()
        return fields

    def _field(self, description: Any) -> tuple[Any, int]:
        """Format and position of a field."""
        node_type, detail = description
        if node_type == Nodetype.BASE:
            if detail[0] == "string":
                size = self._count()
                return f"S{size}", self._skip(size)
            return self._numbers(detail[0], ())
        if node_type == Nodetype.NAME:
            begin = self._place
            return self._structure(self._fields(detail), begin, self._place), begin
        element, size = detail
        if node_type == Nodetype.SEQUENCE:
            size = self._count()
        if element[0] == Nodetype.BASE and element[1][0] != "string":
            return self._numbers(element[1][0], (size,))
        begin = self._place
        elements = [(str(i), *self._field(element)) for i in range(size)]
        return self._structure(elements, begin, self._place), begin

    def _numbers(self, name: str, shape: tuple[int, ...]) -> tuple[Any, int]:
        if name not in _NUMBERS:
            raise LayoutError(f"has a field of the unsupported type {name}{self._in_field()}")
        form = np.dtype(self._order + _NUMBERS[name])
        count = math.prod(shape)  # of a definition, so perhaps larger than any integer of NumPy
        if count:  # an empty sequence has no alignment
            self._skip(-(self._place - _ENCAPSULATION) % form.itemsize)
        return (form, shape), self._skip(count * form.itemsize)

    def _count(self) -> int:
        (form, _), place = self._numbers("uint32", ())
        self.decisive += range(place, place + 4)
        return int(np.frombuffer(self._message, form, 1, place)[0])

    def _skip(self, size: int) -> int:
        """Advance by `size` bytes; return the position before."""
        place = self._place
        self._place += size
        if self._place > len(self._message):
            raise LayoutError(f"ends after {len(self._message)} bytes{self._in_field()}")
        return place

    def _in_field(self) -> str:
        return f", in its field {'.'.join(self._path)}"

    @staticmethod
    def _structure(fields: list[_Field], begin: int, end: int) -> np.dtype[Any]:
        names, formats, places = zip(*fields, strict=True) if fields else ((), (), ())
        return np.dtype(
            {
                "names": names,
                "formats": formats,
                "offsets": [place - begin for place in places],
                "itemsize": end - begin,
            }
        )
