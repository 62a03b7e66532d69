"""A field of the scene and the values it takes in a study, from the text that names them."""

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
    """A field, by its dotted name, and its values in SI."""

    field: str
    values: tuple[Any, ...]


@dataclass(frozen=True)
class Span:
    """A field and the range it is drawn from, ends included."""

    field: str
    low: float
    high: float
    logarithmic: bool = False

    def at(self, share: np.ndarray) -> np.ndarray:
        """Values at `share` (n,) of the way from the low end to the high one."""
        if self.logarithmic:
            return np.asarray(self.low * (self.high / self.low) ** share)
        return np.asarray(self.low + (self.high - self.low) * share)


def read_axis(scene: Scene, field: str, text: str) -> Axis | Span:
    """What `text` says of `field`.

    ``a,b,c`` lists values, ``a:b:n`` gives n of them from a to b and ``a:b:n:log`` in equal ratios;
    ``a:b`` and ``a:b:log`` are ranges to draw from. Values may carry units, as in a scene: all of
    them or none.

    Raises:
        ValueError: `scene` has no such field, it does not take such a value, or the text is none
            of these; names field and text.
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
        raise _refusal(field, text, "must be a,b,c or a:b:n or a:b, with :log for equal ratios")
    span = _span(scene, field, text, numbers, logarithmic)
    return span if len(numbers) == 2 else _spread(scene, span, text, numbers[2])


def read_value(scene: Scene, field: str, given: Any) -> Any:
    """`given` as `scene` takes it for `field`, in SI; raises `SceneError` where it does not."""
    return look_up(scene.replace(**{field: given}), field)[1]


def look_up(scene: Scene, field: str) -> tuple[FieldInfo, Any]:
    """The field of `scene` with this dotted name, and its value.

    Raises:
        SceneError: `scene` does not have it.
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
    """Refuse a unit for some of them: "1,2 rpm" is 1.2 rpm to one, to another 1 rpm and 2 rpm."""
    bare = [value for value in values if is_number(value)]
    if bare and any(map(has_unit, values)):
        raise _refusal(
            field, text, f"{bare[0]} is without a unit, write one with each; decimals have a point"
        )


def _span(scene: Scene, field: str, text: str, ends: list[str], logarithmic: bool) -> Span:
    _check_units(field, text, ends[:2])
    low, high = (read_value(scene, field, end) for end in ends[:2])
    if isinstance(low, bool) or not isinstance(low, (int, float)):
        raise _refusal(field, text, "is no number; list its values")
    if low == high:
        raise _refusal(field, text, "both ends are the same")
    if logarithmic and not low * high > 0.0:
        raise _refusal(field, text, "ends of equal ratios must have one sign, and not be 0")
    return Span(field, low, high, logarithmic)


def _spread(scene: Scene, span: Span, text: str, count: str) -> Axis:
    if not count.isdecimal() or not 2 <= int(count) <= MOST_VALUES:
        raise _refusal(span.field, text, f"{count!r} must be a count within 2 and {MOST_VALUES}")
    values = span.at(np.linspace(0.0, 1.0, int(count)))
    values[-1] = span.high  # to the last bit
    return Axis(span.field, admitted(scene, span, values))


def admitted(scene: Scene, span: Span, values: np.ndarray) -> tuple[Any, ...]:
    """`values` (n,) as the field takes them: a whole number stays one, each only once."""
    whole = isinstance(span.low, int)
    numbers = [round(value) if whole else float(value) for value in values]
    return tuple(dict.fromkeys(read_value(scene, span.field, number) for number in numbers))


def _refusal(field: str, text: str, reason: str) -> ValueError:
    return ValueError(f"{field} = {text!r}: {reason}")
