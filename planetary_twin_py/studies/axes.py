"""Fields of the scene and their values in a study, parsed from text."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Any

import numpy as np
from pydantic.fields import FieldInfo

from ..scene import OperatingPoint, Scene, SceneError
from ..scene.errors import PER_PLANET
from ..scene.names import no_such_field
from ..scene.quantity import unit_of
from ..units.conversion import has_unit, is_number, rpm, to_si

_NORMAL = re.compile(r"normal\(([^,()]+),([^,()]+)\)")
LOGARITHMIC = "log"
MOST_VALUES = 100_000


@dataclass(frozen=True)
class Axis:
    """A field, by its dotted name, and a list of values in SI."""

    field: str
    values: tuple[Any, ...]

    @property
    def ends(self) -> tuple[Any, Any]:
        """First and last value."""
        return self.values[0], self.values[-1]


@dataclass(frozen=True)
class Span:
    """A field and the range, ends included, from which values are sampled."""

    field: str
    low: float
    high: float
    logarithmic: bool = False

    @property
    def ends(self) -> tuple[float, float]:
        """Lowest and highest value."""
        return self.low, self.high

    def at(self, share: np.ndarray) -> np.ndarray:
        """Values (n,) at the fractions `share` (n,) of the range, 0 to 1."""
        if self.logarithmic:
            return np.asarray(self.low * (self.high / self.low) ** share)
        return np.asarray(self.low + (self.high - self.low) * share)


@dataclass(frozen=True)
class Normal:
    """A field and the normal distribution from which values are drawn."""

    field: str
    mean: float
    deviation: float
    """Standard deviation."""

    @property
    def ends(self) -> tuple[float, float]:
        """The mean, which is typed as the ends of a range are."""
        return self.mean, self.mean

    def at(self, share: np.ndarray) -> np.ndarray:
        """Values (n,) below which the shares (n,) of the distribution are, 0 to 1."""
        from scipy.special import ndtri

        return np.asarray(self.mean + self.deviation * ndtri(share))


def planet_by_planet(scene: Scene, field: str, text: str) -> tuple[Scene, tuple[str, ...]]:
    """Fields that vary where `text` is a distribution: of a value for each planet, all of them.

    Args:
        scene: has the field.
        field: dotted name, such as "errors.pin_tangential".
        text: values, see `read_axis`.

    Raises:
        ValueError: see `read_axis`.
    """
    if field.removeprefix("errors.") not in PER_PLANET or not _NORMAL.fullmatch(text):
        return scene, (field,)
    planets = scene.gearset.planets
    mean = _normal(scene, field, text).mean
    entries = tuple(f"{field}.{planet}" for planet in range(planets))
    return scene.replace(**{field: [mean] * planets}), entries


def read_axis(scene: Scene, field: str, text: str) -> Axis | Span | Normal:
    """Parse the values of a field.

    ``a,b,c`` lists values, ``a:b:n`` is n values from a to b with equal steps and ``a:b:n:log``
    with equal ratios; ``a:b`` and ``a:b:log`` are ranges to sample from, and ``normal(m,s)`` is a
    normal distribution with the mean m and the standard deviation s. Either all values have a unit,
    as in a scene, or none has.

    Args:
        scene: has the field.
        field: dotted name.
        text: the values.

    Raises:
        ValueError: `scene` has no such field, a value is out of range, or `text` has none of these
            forms. The message names the field and the text.
    """
    if _NORMAL.fullmatch(text):
        return _normal(scene, field, text)
    if text.startswith("normal("):
        raise _refusal(field, text, "must be normal(mean,deviation)")
    ends = [part.strip() for part in text.split(":")]
    if len(ends) == 1:
        points = [part.strip() for part in text.split(",")]
        _check_units(field, text, points)
        values = (read_value(scene, field, point) for point in points)
        return Axis(field, tuple(dict.fromkeys(values)))
    logarithmic = ends[-1] == LOGARITHMIC
    numbers = ends[:-1] if logarithmic else ends
    if len(numbers) not in (2, 3):
        raise _refusal(field, text, "must be a,b,c, a:b:n, a:b (with :log) or normal(a,b)")
    span = _span(scene, field, text, numbers, logarithmic)
    return span if len(numbers) == 2 else _spread(scene, span, text, numbers[2])


def default_speeds(scene: Scene, share: float, count: str) -> str:
    """Input speeds of a study for which none are given.

    Args:
        scene: the scene.
        share: lowest speed over the highest one [-].
        count: number of speeds, as in a range: "41:log".

    Returns:
        The range up to the largest of 1, 2, 5, 10 ... rpm within `drive.speed_limit`, in the sense
        of the input speed of the scene.
    """
    limit = scene.drive.speed_limit / rpm(1.0)
    decade = 10.0 ** math.floor(math.log10(limit))
    highest = next(part * decade for part in (5.0, 2.0, 1.0) if part * decade <= limit)
    highest = math.copysign(highest, scene.operating_point.input_speed)
    return f"{share * highest:.10g}rpm:{highest:.10g}rpm:{count}"


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


def _normal(scene: Scene, field: str, text: str) -> Normal:
    found = _NORMAL.fullmatch(text)
    assert found is not None
    _check_units(field, text, [part.strip() for part in found.groups()])
    unit = unit_of(look_up(scene, field)[0])
    if unit is None:
        raise _refusal(field, text, "is not a number that a distribution could have")
    if unit == "K" and has_unit(found[2]) and not found[2].strip().endswith("K"):
        raise _refusal(field, text, "a standard deviation of a temperature must be in K")
    try:
        mean, deviation = (float(to_si(part.strip(), unit)) for part in found.groups())  # type: ignore[arg-type]
    except ValueError as error:
        raise _refusal(field, text, f"{error}") from None
    if not 0.0 < deviation < math.inf:
        raise _refusal(field, text, "the standard deviation must be above 0")
    return Normal(field, mean, deviation)


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


def admitted(scene: Scene, span: Span | Normal, values: np.ndarray) -> tuple[Any, ...]:
    """Values (n,) as the field accepts them: rounded for an integer field, without duplicates.

    Args:
        scene: has the field.
        span: the field and its range.
        values: values in SI, (n,).
    """
    whole = isinstance(span, Span) and isinstance(span.low, int)
    numbers = [round(value) if whole else float(value) for value in values]
    return tuple(dict.fromkeys(read_value(scene, span.field, number) for number in numbers))


def _refusal(field: str, text: str, reason: str) -> ValueError:
    return ValueError(f"{field} = {text!r}: {reason}")
