"""The viscosity of an oil from its grade: what `lubrication.iso_vg` defines."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ..lubrication.viscosity import walther_slope
from ..lubrication.viscosity_grade import (
    COLD,
    GRADES,
    HIGHEST_INDEX,
    HOT,
    LOWEST_INDEX,
    hot_viscosity,
)

DEFINED = ("viscosity", "reference_temperature", "viscosity_slope")
"""Fields that a grade defines."""
_DEFINING = ("iso_vg", "viscosity_index", "oil_density")
_ROUNDING = 1e-9


def with_grade(data: dict[str, Any], grade: float, index: float, density: float) -> dict[str, Any]:
    """Fields of an oil with those that its grade defines.

    Args:
        data: values of the fields by name; those that the grade defines are in SI.
        grade: of ISO 3448, its kinematic viscosity at 40 deg C [mm^2/s].
        index: viscosity index [-].
        density: of the oil [kg/m^3].

    Raises:
        ValueError: there is no such grade or oil, or a field contradicts it.
    """
    if grade not in GRADES:
        raise ValueError(f"iso_vg = {grade:g}: must be one of {', '.join(map(str, GRADES))}")
    if not LOWEST_INDEX <= index <= HIGHEST_INDEX:
        allowed = f"must be within {LOWEST_INDEX:g} and {HIGHEST_INDEX:g}"
        raise ValueError(f"viscosity_index = {index:g}: {allowed}")
    cold = 1e-6 * grade
    slope = walther_slope((COLD, cold), (HOT, hot_viscosity(cold, index)))
    defined = dict(zip(DEFINED, (cold * density, COLD, slope), strict=True))
    for name, value in defined.items():
        given = data.get(name, value)
        if not (isinstance(given, float) and math.isclose(given, value, rel_tol=_ROUNDING)):
            raise ValueError(
                f"{name} = {given}: iso_vg = {grade:g} defines it, {value:.6g}; omit one of both"
            )
    return data | defined


def without_other_oil(data: dict[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Fields of an oil without those that changes of others replace.

    Args:
        data: values of the fields by name, before the change.
        changes: values of the fields that change.
    """
    grade = changes.get("iso_vg", data.get("iso_vg"))
    if grade is not None and changes.keys() & {*_DEFINING}:
        return {name: value for name, value in data.items() if name not in DEFINED}
    return data | {"iso_vg": None} if changes.keys() & {*DEFINED} else data
