"""What is wrong with a scene, a line for each error: field, value, what is allowed."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from pydantic import ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from ..units import UnitError
from .names import nearest, no_such_field
from .quantity import Section, bounds, listed, sections_in, unit_of, within

_REASONS = {  # by the type of a defect, where pydantic's words are those of Python
    "model_type": "must be a section",
    "tuple_type": "must be a list",
    "string_type": "must be a text",
    **dict.fromkeys(("int_type", "int_parsing", "int_from_float"), "must be a whole number"),
    **dict.fromkeys(("bool_type", "bool_parsing"), "must be true or false"),
}


class _Place(NamedTuple):
    """Where a defect is: its dotted name, the section it is in and the field, if they are known."""

    name: str
    section: type[Section] | None
    field: FieldInfo | None


def explain(error: ValidationError, model: type[Section]) -> str:
    """All defects of `error`: one is a line; several are a heading and a line each.

    A mistyped name leaves the right one missing, which is not listed as well.

    Args:
        error: of pydantic, from `model`.
        model: the section that was validated.

    Returns:
        The message.
    """
    defects = [(defect, _locate(model, defect["loc"])) for defect in error.errors()]
    meant = {name for defect, place in defects for name in _meant(defect, place)}
    lines = [
        line.removeprefix("operating_point.")
        for defect, place in defects
        if not (defect["type"] == "missing" and place.name in meant)
        for line in _lines(defect, place)
    ]
    return listed(lines)


def _locate(model: type[Section], location: Sequence[str | int]) -> _Place:
    """Follow a location of pydantic, which names the kind of a section where there are several."""
    kinds, parts = [model], []
    section, field = None, None
    for part in location:
        chosen = [kind for kind in kinds if kind.__name__.lower() == part]
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
    """Dotted names of the fields that a mistyped name may be meant for."""
    if defect["type"] == "extra_forbidden" and place.section is not None:
        above, dot, own = place.name.rpartition(".")
        yield from (f"{above}{dot}{name}" for name in nearest(own, place.section.model_fields))


def _lines(defect: ErrorDetails, place: _Place) -> Iterator[str]:
    if defect["type"] == "extra_forbidden":
        yield no_such_field(place.name, place.section.model_fields if place.section else ())
        return
    if defect["type"] == "missing":
        yield f"{place.name}: missing"
        return
    if defect["type"] == "union_tag_invalid":
        tags = defect["ctx"]
        yield f"{place.name}.kind = {tags['tag']!r}: must be one of {tags['expected_tags']}"
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
        yield f"{place.name}: {reason}"
    else:
        allowed = None if _is_of_units(defect) else _allowed(place.field)
        yield f"{place.name} = {defect['input']!r}: {allowed or reason}"


def _is_of_units(defect: ErrorDetails) -> bool:
    return isinstance(defect.get("ctx", {}).get("error"), UnitError)


def _allowed(field: FieldInfo | None) -> str | None:
    """The range of a quantity, in words; None for what is not one."""
    if field is None or (unit := unit_of(field)) is None:
        return None
    low, high = bounds(field)
    if low == -math.inf and high == math.inf:
        return f"must be a finite number in {unit or '1'}"
    return within(low, high, unit)
