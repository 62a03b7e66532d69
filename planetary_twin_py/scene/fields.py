"""The fields of a scene, or of another file, from its schema: unit, default, range and meaning."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from typing import Annotated, Any, Literal, NamedTuple, get_args, get_origin

from pydantic.fields import FieldInfo

from .quantity import Section, bounds, limits_of, sections_in, tag_of, unit_of
from .scene import Scene

REQUIRED = "required"
NONE = "none"
NUMBER = "N"  # in a name: index in a list, from 0


class SceneField(NamedTuple):
    """Description of a field."""

    name: str
    """Dotted, as in `Scene.replace` and `--set`."""
    unit: str
    """"-" for a dimensionless number, empty for other types."""
    default: str
    """In SI, or "required", or "none"."""
    range: str
    """An interval, whose round bracket excludes the end; or the choices, or the contents."""
    meaning: str


class SceneSection(NamedTuple):
    """A section of a scene with its fields, including subsections."""

    name: str
    """Dotted; empty for the scene itself."""
    kind: str
    """Kind of the section if several kinds are allowed there, else empty."""
    meaning: str
    """Docstring of the section."""
    fields: tuple[SceneField, ...]


def scene_sections() -> Iterator[SceneSection]:
    """All sections of a scene, each before its subsections."""
    yield from sections_of(Scene)


def sections_of(model: type[Section]) -> Iterator[SceneSection]:
    """All sections of a file, each before its subsections.

    Args:
        model: section with the fields of the file.
    """
    seen = set[tuple[str, str]]()  # kinds of sections may share a subsection
    for section in _sections("", "", model):
        if (section.name, section.kind) not in seen:
            seen.add((section.name, section.kind))
            yield section


def _sections(name: str, kind: str, model: type[Section]) -> Iterator[SceneSection]:
    prefix = f"{name}." if name else ""
    fields = {f"{prefix}{own}": field for own, field in model.model_fields.items()}
    rows = tuple(_field(dotted, field) for dotted, field in fields.items())
    yield SceneSection(name, kind, inspect.cleandoc(model.__doc__ or ""), rows)
    for dotted, field in fields.items():
        models = sections_in(field.annotation)
        below = dotted if _lengths(field) is None else f"{dotted}.{NUMBER}"
        for one in models:
            yield from _sections(below, tag_of(one) if len(models) > 1 else "", one)


def _field(name: str, field: FieldInfo) -> SceneField:
    unit = "-" if _is_number(field.annotation) else ""
    return SceneField(
        name, unit_of(field) or unit, _default(field), _range(field), field.description or ""
    )


def _is_number(kind: Any) -> bool:
    return kind in (int, float) or any(map(_is_number, get_args(kind)))


def _default(field: FieldInfo) -> str:
    if field.is_required():
        return REQUIRED
    value = field.default
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, Section):
        return "its defaults"
    if isinstance(value, (int, float)):
        return f"{value:g}"
    return str(value) if value else NONE


def _range(field: FieldInfo) -> str:
    lengths = _lengths(field)
    if lengths is not None:
        what = "sections" if sections_in(field.annotation) else "values"
        return f"{lengths[0]} to {lengths[1]} {what}"
    if sections_in(field.annotation):
        return "section"
    if get_origin(field.annotation) is dict:
        return "values by name"
    choices, interval = _choices(field.annotation), _interval(field)
    return ", ".join([interval, *choices] if interval else choices) or "text"


def _lengths(field: FieldInfo) -> tuple[int, int] | None:
    """Minimum and maximum length of a list; None for other fields."""
    limits = limits_of(field)
    most = limits.get("max_length")
    return None if most is None else (int(limits.get("min_length", 0)), int(most))


def _choices(kind: Any) -> tuple[str, ...]:
    if kind is bool:
        return "true", "false"
    if get_origin(kind) is Literal:
        return tuple(map(str, get_args(kind)))
    return tuple(choice for part in get_args(kind) for choice in _choices(part))


def _parts(field: FieldInfo) -> list[FieldInfo]:
    """Annotated parts of the type of a field."""
    parts = (part for part in get_args(field.annotation) if get_origin(part) is Annotated)
    return [FieldInfo.from_annotation(part) for part in parts]


def _interval(field: FieldInfo) -> str:
    limits, (low, high) = limits_of(field), bounds(field)
    if not limits:  # they may be those of a part of the type
        return next(filter(None, map(_interval, _parts(field))), "")
    return f"{'[' if 'ge' in limits else '('}{low:g}, {high:g}{']' if 'le' in limits else ')'}"
