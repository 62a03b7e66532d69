"""Error messages of a scene, a line each: field, value and allowed range."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from pydantic import ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from ..units.conversion import UnitError
from .names import nearest, no_such_field
from .paths import field_paths
from .quantity import (
    Section,
    bounds,
    limit_of,
    limits_of,
    listed,
    sections_in,
    tag_of,
    unit_of,
    within,
)

_REASONS = {  # in place of pydantic's messages, by error type
    "model_type": "must be a section",
    "tuple_type": "must be a list",
    "string_type": "must be text",
    "string_pattern_mismatch": "must be lower-case letters, digits and _, first a letter",
    **dict.fromkeys(
        ("int_type", "int_parsing", "int_parsing_size", "int_from_float"), "must be a whole number"
    ),
    **dict.fromkeys(("bool_type", "bool_parsing"), "must be true or false"),
}


class _Place(NamedTuple):
    """Location of an error: dotted name, and section and field if they are known."""

    name: str
    section: type[Section] | None
    field: FieldInfo | None


def explain(
    error: ValidationError,
    model: type[Section],
    further: Iterable[str] = (),
    what: str = "the scene",
) -> str:
    """Format the errors of a validation: one line, or a heading and a line each.

    If a name is mistyped, the correct name is not listed as missing.

    Args:
        error: raised by pydantic for `model`.
        model: the section that was validated.
        further: lines of errors that were found otherwise.
        what: was validated, for the heading.
    """
    defects = [(defect, _locate(model, defect["loc"])) for defect in error.errors()]
    meant = {name for defect, place in defects for name in _meant(defect, place)}
    lines = [
        line.removeprefix("operating_point.")
        for defect, place in defects
        if not (defect["type"] == "missing" and place.name in meant)
        for line in _lines(defect, place, model)
    ]
    return listed([*lines, *further], what)


def _locate(model: type[Section], location: Sequence[str | int]) -> _Place:
    """Convert a location of pydantic, which contains the kind of a section if there are several."""
    kinds, parts = [model], []
    section, field = None, None
    for part in location:
        chosen = [kind for kind in kinds if tag_of(kind) == part]
        if len(kinds) > 1 and chosen:
            kinds = chosen
            continue
        parts.append(str(part))
        if isinstance(part, str):
            section = kinds[0] if len(kinds) == 1 else None
            field = section.model_fields.get(part) if section else None
            kinds = sections_in(field.annotation) if field else []
    return _Place(".".join(parts), section, field)


def _meant(defect: ErrorDetails, place: _Place) -> Iterator[str]:
    """Dotted names of the fields that a mistyped name may stand for."""
    if defect["type"] == "extra_forbidden" and place.section is not None:
        above, dot, own = place.name.rpartition(".")
        yield from (f"{above}{dot}{name}" for name in nearest(own, place.section.model_fields))


def _lines(defect: ErrorDetails, place: _Place, model: type[Section]) -> Iterator[str]:
    if defect["type"] == "extra_forbidden":
        beside = place.section.model_fields if place.section else ()
        yield no_such_field(place.name, beside, field_paths(model))
        return
    if defect["type"] == "missing":
        yield f"{place.name}: missing"
        return
    if defect["type"] == "union_tag_invalid":
        tags = defect["ctx"]
        field = tags["discriminator"].strip("_()")  # name of the function that reads it
        yield f"{place.name}.{field} = {tags['tag']!r}: must be one of {tags['expected_tags']}"
        return
    if defect["type"] == "union_tag_not_found":
        yield f"{place.name}: must be a section with a kind"
        return
    reason = _REASONS.get(defect["type"]) or defect["msg"].removeprefix("Value error, ").replace(
        "Input should be", "must be", 1
    )
    if not place.name:
        yield from reason.splitlines()
    elif isinstance(defect["input"], dict):
        yield from (f"{place.name}: {line}" for line in reason.splitlines())
    elif defect["type"] in ("too_long", "too_short") and place.field is not None:
        yield f"{place.name}: has {len(defect['input'])} entries: {_lengths(place.field)}"
    else:
        allowed = None if _is_of_units(defect) else _allowed(place.field, defect["input"])
        empty = "; the field is empty" if defect["input"] is None else ""
        yield f"{place.name} = {defect['input']!r}: {allowed or reason}{empty}"


def _lengths(field: FieldInfo) -> str:
    """Description of the lengths that a list may have."""
    limits = limits_of(field)
    lengths = [limits[name] for name in ("min_length", "max_length") if name in limits]
    return f"must have {'at most ' if len(lengths) == 1 else ''}{' to '.join(map(str, lengths))}"


def _is_of_units(defect: ErrorDetails) -> bool:
    return isinstance(defect.get("ctx", {}).get("error"), UnitError)


def _allowed(field: FieldInfo | None, given: object) -> str | None:
    """Description of the range of a quantity for a refused value; None for other fields."""
    if field is None or (unit := unit_of(field)) is None:
        return None
    low, high = bounds(field)
    if low == -math.inf and high == math.inf:
        return f"must be a finite number in {unit or '1'}"
    ends = [end for name, end in limits_of(field).items() if name in ("gt", "lt")]
    excluded = f", not {given:g}" if given in ends else ""
    further = limit_of(field)
    return within(low, high, unit) + excluded + (f", and within {further}" if further else "")
