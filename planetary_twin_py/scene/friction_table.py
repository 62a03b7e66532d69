"""A friction coefficient as a table over the quantities that it depends on."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from typing import Self

from pydantic import model_validator

from .quantity import Section, quantity

MOST_VALUES = 16  # of a quantity
MOST_COEFFICIENTS = 1024
AXES = ("lambda_ratio", "pressure", "rolling_speed", "sliding_speed")


class FrictionTable(Section):
    """Friction coefficient of a tooth pair, boundary friction included.

    Each quantity has ascending values; the coefficient does not depend on one that has none.
    Between the values, the coefficient is linear in the logarithms of the quantities; beyond them
    it is constant. `planetary_twin_py.friction_table` makes a table of a function.
    """

    lambda_ratio: tuple[float, ...] = quantity(
        "", "values of the lambda ratio", (), max_length=MOST_VALUES
    )
    pressure: tuple[float, ...] = quantity(
        "Pa", "values of the mean Hertz pressure", (), max_length=MOST_VALUES
    )
    rolling_speed: tuple[float, ...] = quantity(
        "m/s", "values of the mean surface speed", (), max_length=MOST_VALUES
    )
    sliding_speed: tuple[float, ...] = quantity(
        "m/s", "values of the sliding speed", (), max_length=MOST_VALUES
    )
    coefficient: tuple[float, ...] = quantity(
        "",
        "friction coefficients, each within 0 and 1, for all combinations of the values; "
        "the last quantity varies fastest",
        min_length=1,
        max_length=MOST_COEFFICIENTS,
    )

    @model_validator(mode="after")
    def _is_a_grid(self) -> Self:
        for name in AXES:
            values = getattr(self, name)
            if any(b <= a for a, b in itertools.pairwise((0.0, *values))):
                raise ValueError(f"{name} = {values!r}: must be positive and ascending")
        count = math.prod(max(len(getattr(self, name)), 1) for name in AXES)
        if len(self.coefficient) != count:
            raise ValueError(
                f"coefficient: has {len(self.coefficient)} entries: must have {count}, one for "
                "each combination of the values"
            )
        if wrong := [value for value in self.coefficient if not 0.0 <= value <= 1.0]:
            raise ValueError(f"coefficient = {wrong[0]!r}: must be within 0 and 1")
        return self


def friction_table(law: Callable[..., float], **values: Sequence[float]) -> FrictionTable:
    """Tabulate a friction law of one's own.

    The table is part of the scene, so it is recorded, simulated again and verified with it. A scene
    uses it with ``lubrication.traction = "table"``.

    Args:
        law: called with a value of each quantity in `values` by name; returns the friction
            coefficient [-] of a tooth pair, boundary friction included.
        values: ascending values of the quantities on which the law depends, at most 16 each and
            1024 combinations: lambda_ratio [-], pressure (mean Hertz pressure [Pa]),
            rolling_speed (mean surface speed [m/s]), sliding_speed [m/s].

    Returns:
        The table, for the field ``lubrication.friction_table``.

    Raises:
        ValueError: a quantity is unknown, values are not ascending, or a coefficient is outside
            0 to 1.
    """
    for name in values:
        if name not in AXES:
            raise ValueError(f"{name}: no such quantity; must be one of {', '.join(AXES)}")
    names = [name for name in AXES if name in values]
    grid = itertools.product(*(map(float, values[name]) for name in names))
    coefficients = tuple(float(law(**dict(zip(names, at, strict=True)))) for at in grid)
    axes = {name: tuple(map(float, values[name])) for name in names}
    return FrictionTable.model_validate({**axes, "coefficient": coefficients})
