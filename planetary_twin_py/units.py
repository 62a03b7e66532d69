"""Units at the edge: inside, every quantity is in SI."""

from __future__ import annotations

import math
from functools import cache
from typing import Any


def rpm(value: float) -> float:
    """Revolutions per minute in rad/s."""
    return value * math.pi / 30.0


@cache
def _registry() -> Any:
    import pint  # Costs 0.2 s, and most values come without a unit.

    registry = pint.UnitRegistry(autoconvert_offset_to_baseunit=True)
    # pint's own rpm is revolution/minute; the short form is what people write in a scene.
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
    import pint

    try:
        return float(_registry().Quantity(value).to(unit or "dimensionless").magnitude)
    except pint.DimensionalityError:
        raise ValueError(f"{value!r} is not a quantity in {unit or '1'}") from None
    except Exception:
        raise ValueError(f"{value!r} is not a number with a unit") from None
