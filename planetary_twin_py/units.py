"""Units at the edge: inside, every quantity is in SI."""

from __future__ import annotations

import math
import re
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

_QUANTITY = re.compile(r"([-+]?[\d._]+(?:[eE][-+]?\d+)?)\s*(\S.*)")
_POWER = re.compile(r"(?<=[^\W\d_])(-?\d)")  # of mm2, min-1
_INSTEAD = (  # a unit often given, that which is wanted, and what to write
    ("1/s", "rad/s", "turns are told in rpm or rev/s"),
    ("U/min", "rad/s", "write rpm"),
    ("C", "K", "write degC"),
    ("deg C", "K", "write degC"),
    ("F", "K", "write degF"),
    ("m^2/s", "Pa s", "dynamic viscosity = kinematic viscosity x density"),
    ("kg m^2", "kg", "it is J/r^2 of a moment of inertia J"),
)


_CUSTOMARY = {  # by the SI unit: unit, how many of it one of SI is, and its zero in them
    "rad/s": ("rpm", 30.0 / math.pi, 0.0),
    "rad": ("deg", 180.0 / math.pi, 0.0),
    "K": ("degC", 1.0, 273.15),
    "Pa": ("MPa", 1e-6, 0.0),
}


# pint evaluates a unit as an expression: of 10**10**10 it would compute every digit.
_LONGEST_UNIT = 60  # characters
_MANY_DIGITS = re.compile(r"\d{4}|[⁰¹²³⁴-⁹]{3}")
_POWERS = re.compile(r"\*\*|\^")
_RAISED = re.compile(r"[^\W\d]\s*(?:\*\*|\^)\s*\(?[-+]?\d{1,2}(?![\d\s]*[\d*^])")  # a name is


class UnitError(ValueError):
    """A number in a unit that is none here, or with a comma: no range would explain it."""


def rpm(value: float) -> float:
    """Revolutions per minute in rad/s."""
    return value * math.pi / 30.0


@cache
def _registry() -> Any:
    import pint  # Costs 0.2 s, and most values come without a unit.

    registry: Any = pint.UnitRegistry(
        autoconvert_offset_to_baseunit=True,
        preprocessors=[lambda text: _POWER.sub(r"**\1", text)],
    )
    registry.define("newton_metre = newton * metre = Nm")  # else a number of metres
    registry.define("@alias turn = rev")
    return registry


def to_si(value: object, unit: str) -> object:
    """Convert ``"0.2 um"`` to a float in `unit`; pass on what carries no unit of its own.

    Raises:
        UnitError: the text has a comma, or a unit of another quantity than `unit`.
        ValueError: the text is no number with a unit, or the value is true or false.
    """
    if isinstance(value, bool):
        raise ValueError("must be a number, not true or false")
    if not isinstance(value, str):
        return value
    if "," in value:
        raise UnitError("write a decimal point, not a comma")
    if is_number(value):  # YAML reads "2e8" as text
        return float(value)
    parts = _QUANTITY.fullmatch(value.strip())
    # Number and unit apart: an expression in which pint reads both loses signs that it knows not.
    if parts is None or not is_number(parts[1]):
        raise ValueError(f"{value!r} is not a number with a unit")
    return float(column_to_si(np.array(float(parts[1])), parts[2], unit))


def customary(value: float, unit: str) -> str:
    """A quantity in the unit that engineers use: 1000 rad/s is "9549 rpm"; empty without one.

    Args:
        value: in SI.
        unit: the SI unit of `value`.

    Returns:
        Number and unit, in four digits.
    """
    if unit == "m":
        return f"{1e6 * value:.4g} um" if abs(value) < 1e-4 else f"{1e3 * value:.4g} mm"
    name, factor, zero = _CUSTOMARY.get(unit, ("", 1.0, 0.0))
    return f"{factor * value - zero:.4g} {name}" if name else ""


def is_number(text: str) -> bool:
    """Whether `text` is a number without a unit."""
    try:
        float(text)
    except ValueError:
        return False
    return True


def has_unit(text: str) -> bool:
    """Whether `text` begins with a number and goes on."""
    return not is_number(text) and _QUANTITY.fullmatch(text.strip()) is not None


def column_to_si(values: NDArray[np.float64], given: str, unit: str) -> NDArray[np.float64]:
    """Convert `values` in the unit `given`, e.g. "rpm", to the SI unit `unit`; "-" is that of 1.

    Raises:
        UnitError: `given` is no unit of the same quantity.
    """
    if not _alike(given, unit):
        raise UnitError(f"[{given}] is no unit that goes into {unit or '1'}{_instead(given, unit)}")
    source, target = _unit(given), _unit(unit)
    return np.asarray(_registry().Quantity(values, source).to(target).magnitude, dtype=float)


def _instead(given: str, unit: str) -> str:
    """What to write for `given`, as the end of a refusal; empty where that is not known."""
    for source, target, advice in _INSTEAD:
        if _alike(given, source) and _alike(unit, target):
            return f"; {advice}"
    return ""


def _unit(name: str) -> Any:
    powers = len(_RAISED.findall(name))
    if (
        len(name) > _LONGEST_UNIT
        or _MANY_DIGITS.search(name)
        or len(_POWERS.findall(name)) > powers
    ):
        raise UnitError("must be units with powers of one or two digits")
    return _registry().Unit("" if name == "-" else name)


def _alike(one: str, other: str) -> bool:
    """Whether two texts are units of the same quantity.

    A speed has an angle in its unit: "1/min" is none of rad/s, lest a turn count as a radian.
    """
    registry = _registry()
    try:
        roots = [registry.get_root_units(_unit(name))[1] for name in (one, other)]
    except Exception:  # of many kinds, for a text that is no unit
        return False
    return bool(roots[0] == roots[1])
