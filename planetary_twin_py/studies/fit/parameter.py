"""Free parameters: quantities of the scene with their ranges and initial values."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from ...scene import Scene
from ...scene.quantity import bounds, unit_of
from ...scene.unused import not_in_use
from ..axes import look_up, read_value

SHARE_OF_RANGE = 1e-3  # fraction of the range that scales a parameter with initial value 0


class Parameter(NamedTuple):
    """A quantity to estimate, in SI."""

    name: str
    unit: str
    low: float
    high: float
    start: float

    @property
    def scale(self) -> float:
        """Magnitude that scales changes of the parameter."""
        width = self.high - self.low
        return abs(self.start) or (SHARE_OF_RANGE * width if math.isfinite(width) else 1.0)


def read_parameters(
    scene: Scene, names: Sequence[str], starts: Mapping[str, Any]
) -> tuple[Parameter, ...]:
    """Free parameters by dotted names of fields of the scene, with other `starts` for some.

    Raises `ValueError` if there is no name, a name occurs twice, is not a continuous quantity or
    has no effect in the scene, or an initial value is out of range or not of a free parameter.
    """
    if not names:
        raise ValueError("no free parameter: name at least one field, e.g. backlash")
    for name in (*names, *starts):
        if list(names).count(name) != 1:
            raise ValueError(f"{name}: " + ("given twice" if name in names else "is not free"))
    return tuple(_parameter(scene, name, starts.get(name)) for name in names)


def _parameter(scene: Scene, name: str, start: Any) -> Parameter:
    info, value = look_up(scene, name)
    if unit_of(info) is None or not isinstance(value, float):
        raise ValueError(f"{name} = {value!r}: only a continuous quantity can be estimated")
    if reason := not_in_use(scene, name):
        raise ValueError(f"{name}: cannot be estimated: {reason}")
    tunable = scene.tunables.get(name)
    low, high = (tunable.minimum, tunable.maximum) if tunable else bounds(info)
    begin = value if start is None else read_value(scene, name, start)
    return Parameter(name, unit_of(info) or "", low, high, begin)
