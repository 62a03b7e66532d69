"""Scene fields with a unit, a meaning and a range; errors that name all three."""

from __future__ import annotations

import math
from typing import Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError, ValidationInfo, field_validator
from pydantic.fields import FieldInfo

from ..units import to_si


class SceneError(ValueError):
    """A scene that cannot be: one line that names the field, the value and the allowed range."""


class Section(BaseModel):
    """Part of a scene: immutable, strict about names it does not know, SI inside."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    @field_validator("*", mode="before")
    @classmethod
    def _units_at_the_edge(cls, value: object, info: ValidationInfo) -> object:
        unit = unit_of(cls.model_fields[info.field_name or ""])
        if unit is None:
            return value
        if isinstance(value, (list, tuple)):
            return tuple(to_si(item, unit) for item in value)
        return to_si(value, unit)


def quantity(unit: str, description: str, default: Any = ..., **limits: Any) -> Any:
    """Field in `unit` with pydantic limits (ge, gt, le, lt)."""
    return Field(default, description=description, json_schema_extra={"unit": unit}, **limits)


def unit_of(field: FieldInfo) -> str | None:
    """Unit of a field, None for one that is not a quantity."""
    extra = field.json_schema_extra
    return str(extra["unit"]) if isinstance(extra, dict) and "unit" in extra else None


def bounds(field: FieldInfo) -> tuple[float, float]:
    """Smallest and largest value a field admits."""
    low, high = -math.inf, math.inf
    for item in field.metadata:
        low = max(low, getattr(item, "ge", -math.inf), getattr(item, "gt", -math.inf))
        high = min(high, getattr(item, "le", math.inf), getattr(item, "lt", math.inf))
    return low, high


def explain(error: ValidationError, model: type[BaseModel]) -> str:
    """The first defect of `error` in one line: field, value, what is allowed."""
    defect = error.errors(include_url=False)[0]
    path = [str(part) for part in defect["loc"]]
    name = ".".join(path) or "scene"
    if defect["type"] == "extra_forbidden":
        return f"{name}: no such field"
    if defect["type"] == "missing":
        return f"{name}: missing"
    reason = defect["msg"].removeprefix("Value error, ")
    if not path or isinstance(defect["input"], dict):
        return f"{name}: {reason}" if path else reason
    return f"{name} = {defect['input']!r}: {_allowed(model, path) or reason}"


def _allowed(model: type[BaseModel], path: list[str]) -> str | None:
    """The range of the field at `path`, in words; None if it has none."""
    field = None
    for part in path:
        field = model.model_fields.get(part)
        if field is None:
            return None
        if isinstance(field.annotation, type) and issubclass(field.annotation, BaseModel):
            model = field.annotation
    if field is None or unit_of(field) is None:
        return None
    low, high = bounds(field)
    if low == -math.inf and high == math.inf:
        return f"must be a finite number in {unit_of(field) or '1'}"
    return within(low, high, unit_of(field) or "")


def within(low: float, high: float, unit: str) -> str:
    """A range in words."""
    return f"must be a number within {low:g} and {high:g} {unit}".rstrip()
