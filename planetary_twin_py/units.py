"""Units at the edge: inside, every quantity is in SI."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray


def rpm(value: float) -> float:
    """Revolutions per minute in rad/s."""
    return value * math.pi / 30.0


@cache
def _registry() -> Any:
    import pint  # Costs 0.2 s, and most values come without a unit.

    registry: Any = pint.UnitRegistry(autoconvert_offset_to_baseunit=True)
    registry.define("newton_metre = newton * metre = Nm")  # else a number of metres
    return registry


def to_si(value: object, unit: str) -> object:
    """Convert ``"0.2 um"`` to a float in `unit`; pass on what carries no unit of its own.

    Raises:
        ValueError: the text is not a quantity, or its dimension is not that of `unit`.
    """
    if not isinstance(value, str):
        return value
    try:
        return float(value)  # YAML reads "2e8" as text
    except ValueError:
        pass
    target = _registry().Unit(unit)
    try:
        quantity = _registry().Quantity(value)
        alike = _alike(quantity.units, target)
    except Exception:
        raise ValueError(f"{value!r} is not a number with a unit") from None
    if not alike:
        raise ValueError(f"{value!r} is not a quantity in {unit or '1'}")
    return float(quantity.to(target).magnitude)


def column_to_si(values: NDArray[np.float64], given: str, unit: str) -> NDArray[np.float64]:
    """Convert `values` in the unit `given`, e.g. "rpm", to the SI unit `unit`; "-" is that of 1.

    Raises:
        ValueError: `given` is no unit of the same quantity.
    """
    registry = _registry()
    try:
        source, target = (registry.Unit("" if name == "-" else name) for name in (given, unit))
        alike = _alike(source, target)
    except Exception:
        alike = False
    if not alike:
        raise ValueError(f"[{given}] is no unit that goes into {unit or '1'}")
    converted = registry.Quantity(values, source).to(target).magnitude
    return np.asarray(converted, dtype=float)


def _alike(source: Any, target: Any) -> bool:
    """Whether units are of the same quantity.

    A speed has an angle in its unit: "1/min" is none of rad/s, lest a turn count as a radian.
    """
    registry = _registry()
    return bool(registry.get_root_units(source)[1] == registry.get_root_units(target)[1])
