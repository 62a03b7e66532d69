"""Scene fields with unit, description and range."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Literal, get_args, get_origin

from pydantic import BaseModel, ConfigDict, Field, ValidationInfo, field_validator
from pydantic.fields import FieldInfo

from ..text.escaping import one_line
from ..units.conversion import UnitError, is_number, to_si

_MOST_LINES = 30  # of a message
_LONGEST_LINE = 400  # characters
_WHOLE = (int, int | None)  # types of fields without a unit
_LISTS = {"m": "[20 um, 0 um]", "rad": "[0 deg, 120 deg]"}  # examples of lists by unit


class SceneError(ValueError):
    """An invalid scene.

    The message is a line with the field, the value and the allowed range, or, for several errors,
    a heading and a line each.
    """


def listed(errors: Sequence[str], what: str = "the scene") -> str:
    """Message of one or more errors of `what`, a line each; very long lists are truncated."""
    if len(errors) == 1:
        return one_line(errors[0], _LONGEST_LINE)
    lines = [one_line(error, _LONGEST_LINE) for error in errors[:_MOST_LINES]]
    if len(errors) > _MOST_LINES:
        lines.append(f"and {len(errors) - _MOST_LINES} more")
    return "\n  ".join((f"{what} has {len(errors)} errors:", *lines))


class Section(BaseModel):
    """Part of a scene: immutable, in SI, rejects unknown names."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    @field_validator("*", mode="before")
    @classmethod
    def _units_at_the_edge(cls, value: object, info: ValidationInfo) -> object:
        field = cls.__pydantic_fields__[info.field_name or ""]
        if type(value) is float and not _is_list(field):  # in SI, the most frequent case
            return value
        if isinstance(value, bool) and field.annotation is not bool:
            raise ValueError("must not be true or false")  # Python would convert them to 1 and 0
        unit = unit_of(field)
        if unit is None:
            if field.annotation in _WHOLE and isinstance(value, str) and not is_number(value):
                raise ValueError("must be a whole number")  # pydantic would accept 1_0
            return value
        if isinstance(value, str) and value in _words(field.annotation):
            return value
        if isinstance(value, (list, tuple)):
            return tuple(to_si(item, unit) for item in value)
        if isinstance(value, (str, int, float)) and _is_list(field):
            raise UnitError(f"must be a list, e.g. {_LISTS.get(unit, '[1, 2]')}")
        return to_si(value, unit)


def quantity(
    unit: str, description: str, default: Any = ..., limited_by: str | None = None, **limits: Any
) -> Any:
    """Make a field of a section.

    Args:
        unit: SI unit; empty for a dimensionless number.
        description: of the quantity.
        default: in SI; `...` for a required field.
        limited_by: field of the scene that limits the magnitude further.
        limits: ge, gt, le and lt of pydantic, in SI.

    Returns:
        A pydantic field.
    """
    extra: dict[str, Any] = {"unit": unit}
    if limited_by is not None:
        extra["limited_by"] = limited_by
    return Field(default, description=description, json_schema_extra=extra, **limits)


def unit_of(field: FieldInfo) -> str | None:
    """Unit of a field, None for one that is not a quantity."""
    extra = field.json_schema_extra
    return str(extra["unit"]) if isinstance(extra, dict) and "unit" in extra else None


def limit_of(field: FieldInfo) -> str | None:
    """Field of the scene that limits the magnitude of a quantity further, if there is one."""
    extra = field.json_schema_extra
    return str(extra["limited_by"]) if isinstance(extra, dict) and "limited_by" in extra else None


def _is_list(field: FieldInfo) -> bool:
    return get_origin(field.annotation) is tuple


def _words(kind: Any) -> tuple[Any, ...]:
    """Words that a field of this type allows in place of a number."""
    return tuple(
        word for part in get_args(kind) if get_origin(part) is Literal for word in get_args(part)
    )


def sections_in(kind: Any) -> list[type[Section]]:
    """Sections that a field of this type may contain."""
    if isinstance(kind, type) and issubclass(kind, Section):
        return [kind]
    return [section for part in get_args(kind) for section in sections_in(part)]


def tag_of(section: type[Section]) -> str:
    """Value of the field `kind` or `law` by which a section is chosen from several; else empty."""
    for name in ("kind", "law"):
        if name in section.model_fields:
            return str(get_args(section.model_fields[name].annotation)[0])
    return ""


def limits_of(field: FieldInfo) -> dict[str, float]:
    """Limits of a field by the names of pydantic: ge, gt, le, lt, min_length and max_length."""
    names = ("ge", "gt", "le", "lt", "min_length", "max_length")
    return {n: getattr(item, n) for item in field.metadata for n in names if hasattr(item, n)}


def bounds(field: FieldInfo) -> tuple[float, float]:
    """Smallest and largest allowed value of a field."""
    limits = limits_of(field)
    low = limits.get("ge", limits.get("gt", -math.inf))
    return low, limits.get("le", limits.get("lt", math.inf))


def within(low: float, high: float, unit: str) -> str:
    """Description of a range."""
    return f"must be a number within {low:g} and {high:g} {unit}".rstrip()


def kind(section: object) -> object:
    """Kind of a fault or sensor, by which its section is chosen; messages name this function."""
    return section.get("kind") if isinstance(section, dict) else getattr(section, "kind", None)
