"""Short texts of public objects in one line, for a prompt or a log."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np

from .escaping import one_line

_LONGEST = 80  # characters of a value


def brief(thing: object, *parts: str) -> str:
    """Name of the class of an object with some facts: `Twin(paper, 0.1 s)`.

    Args:
        thing: any object.
        parts: texts about it.
    """
    return f"{type(thing).__name__}({', '.join(one_line(part, _LONGEST) for part in parts)})"


def brief_record(record: Any) -> str:
    """Fields of a dataclass or named tuple other than None: `Spectrum(frequency=(64,), ...)`.

    Args:
        record: the object; arrays are shown by their shapes, scenes and others that have a name by
            it, tuples and mappings by their lengths.
    """
    return brief(record, *(f"{name}={_text(value)}" for name, value in _fields(record)))


def _fields(record: Any) -> Iterator[tuple[str, Any]]:
    names = [f.name for f in fields(record)] if is_dataclass(record) else record._fields
    given = ((name, getattr(record, name)) for name in names)
    return ((name, value) for name, value in given if value is not None)


def _text(value: object) -> str:
    if isinstance(name := getattr(value, "name", None), str):
        return name
    if isinstance(value, np.ndarray):
        return str(value.shape)
    if isinstance(value, float):
        return f"{value:g}"
    if isinstance(value, (tuple, list, Mapping)):
        return f"{len(value)} items"
    return repr(value)
