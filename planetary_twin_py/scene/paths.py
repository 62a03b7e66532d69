"""Dotted paths into a scene: through sections, list entries and optional sections."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from .quantity import Section, limits_of, sections_in


class NoSuchPath(LookupError):
    """A path that does not exist; the message is empty if a name is not that of a field."""


def with_value(
    data: Any, kinds: Sequence[type[Section]], path: Sequence[str], value: Any, above: str = ""
) -> Any:
    """Copy plain data with another value at `path`.

    An optional section that is missing is created empty, so that several changes can fill it.

    Args:
        data: mapping of a section, or a list, where the path starts.
        kinds: sections that `data`, or the entries of the list, may be.
        path: names of fields, and indices of entries, counted from 0.
        value: new value.
        above: dotted path of `data`, for error messages.

    Returns:
        The changed copy.

    Raises:
        NoSuchPath: a field or an entry does not exist.
    """
    name, *rest = path
    inside = f"{above}.{name}".removeprefix(".")
    if isinstance(data, (list, tuple)):
        place = _entry(data, name, above)
        inner = with_value(data[place], kinds, rest, value, inside) if rest else value
        return [*data[:place], inner, *data[place + 1 :]]
    fields = [kind.model_fields[name] for kind in kinds if name in kind.model_fields]
    if not fields or not isinstance(data, dict):
        raise NoSuchPath
    if not rest:
        return data | {name: value}
    below = [section for field in fields for section in sections_in(field.annotation)]
    inner = data.get(name)
    if inner is None and below:
        inner = {}
    return data | {name: with_value(inner, below, rest, value, inside)}


def _entry(data: Sequence[Any], name: str, above: str) -> int:
    if name.isdecimal() and int(name) < len(data):
        return int(name)
    count = "1 entry" if len(data) == 1 else f"{len(data)} entries"
    remedy = ", counted from 0" if data else f"; set {above} as a whole"
    raise NoSuchPath(f"{above} has {count}{remedy}")


def paths(data: Any) -> Iterator[str]:
    """Dotted names of all fields and entries of plain data, parents first."""
    for name, inner in _entries(data):
        yield name
        yield from (f"{name}.{path}" for path in paths(inner))


def field_paths(section: type[Section]) -> Iterator[str]:
    """Dotted names of all fields of a section and of the sections within it, parents first.

    Those of sections in lists are left out, as their names depend on their place.
    """
    for name, field in section.model_fields.items():
        yield name
        for inner in () if "max_length" in limits_of(field) else sections_in(field.annotation):
            yield from (f"{name}.{path}" for path in field_paths(inner))


def leaves(data: Any) -> Iterator[tuple[str, Any]]:
    """Dotted names and values of plain data that are neither mappings nor lists."""
    for name, inner in _entries(data):
        if isinstance(inner, (dict, list, tuple)):
            yield from ((f"{name}.{path}", value) for path, value in leaves(inner))
        else:
            yield name, inner


def _entries(data: Any) -> Iterator[tuple[str, Any]]:
    if isinstance(data, (list, tuple)):
        yield from ((str(place), entry) for place, entry in enumerate(data))
    elif isinstance(data, Mapping):
        yield from data.items()
