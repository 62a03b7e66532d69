"""What is wrong with a scene, in one line: field, value, what is allowed."""

from __future__ import annotations

import math

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from ..units import UnitError
from .names import no_such_field
from .quantity import Section, bounds, sections_in, unit_of, within


def explain(error: ValidationError, model: type[Section]) -> str:
    """The first defect of `error`, those names first that there are not.

    One that is mistyped leaves the right one missing, which tells less.
    """
    defects = error.errors(include_url=False)
    defect = min(defects, key=lambda one: one["type"] != "extra_forbidden")
    path = [str(part) for part in defect["loc"]]
    name = ".".join(path) or "scene"
    if defect["type"] == "extra_forbidden":
        section = _section(model, path[:-1])
        return no_such_field(name, section.model_fields if section else ())
    if defect["type"] == "missing":
        return f"{name}: missing"
    reason = defect["msg"].removeprefix("Value error, ")
    if not path or isinstance(defect["input"], dict):
        return f"{name}: {reason}" if path else reason
    allowed = None if _is_of_units(defect) else _allowed(model, path)
    return f"{name} = {defect['input']!r}: {allowed or reason}"


def _is_of_units(defect: ErrorDetails) -> bool:
    return isinstance(defect.get("ctx", {}).get("error"), UnitError)


def _allowed(model: type[Section], path: list[str]) -> str | None:
    """The range of the field at `path`, in words; None if it has none."""
    section = _section(model, path[:-1])
    field = section.model_fields.get(path[-1]) if section else None
    if field is None or unit_of(field) is None:
        return None
    low, high = bounds(field)
    if low == -math.inf and high == math.inf:
        return f"must be a finite number in {unit_of(field) or '1'}"
    return within(low, high, unit_of(field) or "")


def _section(model: type[Section], path: list[str]) -> type[Section] | None:
    """The section at `path` below `model`; None where there may be several kinds, or none."""
    for part in path:
        field = model.model_fields.get(part)
        kinds = sections_in(field.annotation) if field else []
        if len(kinds) != 1:
            return None
        model = kinds[0]
    return model
