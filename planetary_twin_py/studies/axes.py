"""Fields of the scene and their values in a study, parsed from text."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from pydantic.fields import FieldInfo

from ..scene import OperatingPoint, Scene, SceneError
from ..scene.names import no_such_field
from ..units import has_unit, is_number

LOGARITHMIC = "log"
MOST_VALUES = 100_000


@dataclass(frozen=True)
class Axis:
    """A field, by its dotted name, and a list of values in SI."""

    field: str
    values: tuple[Any, ...]


@dataclass(frozen=True)
class Span:
    """A field and the range, ends included, from which values are sampled."""

    field: str
    low: float
    high: float
    logarithmic: bool = False

    def at(self, share: np.ndarray) -> np.ndarray:
        """Values (n,) at the fractions `share` (n,) of the range, 0 to 1."""
        if self.logarithmic:
            return np.asarray(self.low * (self.high / self.low) ** share)
        return np.asarray(self.low + (self.high - self.low) * share)


def read_axis(scene: Scene, field: str, text: str) -> Axis | Span:
    """Parse the values of a field.

    ``a,b,c`` lists values, ``a:b:n`` is n values from a to b with equal steps and ``a:b:n:log``
    with equal ratios; ``a:b`` and ``a:b:log`` are ranges to sample from. Either all values have a
    unit, as in a scene, or none has.

    Args:
        scene: has the field.
        field: dotted name.
        text: the values.

    Returns:
        The values, or the range.

    Raises:
        ValueError: `scene` has no such field, a value is out of range, or `text` has none of these
            forms. The message names the field and the text.
    """
    ends = [part.strip() for part in text.split(":")]
    if len(ends) == 1:
        points = [part.strip() for part in text.split(",")]
        _check_units(field, text, points)
        values = (read_value(scene, field, point) for point in points)
        return Axis(field, tuple(dict.fromkeys(values)))
    logarithmic = ends[-1] == LOGARITHMIC
    numbers = ends[:-1] if logarithmic else ends
    if len(numbers) not in (2, 3):
        raise _refusal(field, text, "must be a,b,c or a:b:n or a:b, with :log for logarithmic")
    span = _span(scene, field, text, numbers, logarithmic)
    return span if len(numbers) == 2 else _spread(scene, span, text, numbers[2])


def read_value(scene: Scene, field: str, given: Any) -> Any:
    """Convert a value of a field to SI.

    Args:
        scene: has the field.
        field: dotted name.
        given: value, or text with a unit.

    Returns:
        The value in SI, as the scene has it.

    Raises:
        SceneError: the field does not exist, or the value is out of range.
    """
    return look_up(scene.replace(**{field: given}), field)[1]


def look_up(scene: Scene, field: str) -> tuple[FieldInfo, Any]:
    """Find a field of a scene.

    Args:
        scene: where to look.
        field: dotted name.

    Returns:
        The description of the field, and its value in SI.

    Raises:
        SceneError: `scene` does not have the field.
    """
    path = field.split(".")
    if field in OperatingPoint.model_fields:
        path = ["operating_point", field]
    node: Any = scene
    info = None
    try:
        for part in path:
            if isinstance(node, tuple):
                node = node[int(part)]
            else:
                info, node = type(node).model_fields[part], getattr(node, part)
    except (AttributeError, LookupError, ValueError):
        info = None
    if info is None:
        raise SceneError(no_such_field(field, scene.field_names))
    return info, node


def _check_units(field: str, text: str, values: list[str]) -> None:
    """Reject values with and without units: "1,2 rpm" may mean 1.2 rpm, or 1 rpm and 2 rpm."""
    bare = [value for value in values if is_number(value)]
    if bare and any(map(has_unit, values)):
        raise _refusal(
            field,
            text,
            f"{bare[0]} has no unit; write a unit with each value, and decimals with a point",
        )


def _span(scene: Scene, field: str, text: str, ends: list[str], logarithmic: bool) -> Span:
    _check_units(field, text, ends[:2])
    low, high = (read_value(scene, field, end) for end in ends[:2])
    if isinstance(low, bool) or not isinstance(low, (int, float)):
        raise _refusal(field, text, "is not a number; list its values")
    if low == high:
        raise _refusal(field, text, "both ends are equal")
    if logarithmic and not low * high > 0.0:
        raise _refusal(field, text, "the ends of a logarithmic range must have the same sign")
    return Span(field, low, high, logarithmic)


def _spread(scene: Scene, span: Span, text: str, count: str) -> Axis:
    if not count.isdecimal() or not 2 <= int(count) <= MOST_VALUES:
        raise _refusal(span.field, text, f"{count!r} must be a count within 2 and {MOST_VALUES}")
    values = span.at(np.linspace(0.0, 1.0, int(count)))
    values[-1] = span.high  # exactly
    return Axis(span.field, admitted(scene, span, values))


def admitted(scene: Scene, span: Span, values: np.ndarray) -> tuple[Any, ...]:
    """Values (n,) as the field accepts them: rounded for an integer field, without duplicates.

    Args:
        scene: has the field.
        span: the field and its range.
        values: values in SI, (n,).
    """
    whole = isinstance(span.low, int)
    numbers = [round(value) if whole else float(value) for value in values]
    return tuple(dict.fromkeys(read_value(scene, span.field, number) for number in numbers))


def _refusal(field: str, text: str, reason: str) -> ValueError:
    return ValueError(f"{field} = {text!r}: {reason}")
