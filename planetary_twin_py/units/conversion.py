"""Conversion of units at the interfaces; internally every quantity is in SI."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

LARGEST = 2.0**53
"""Magnitude in SI of a measured value, up to which counts are exact and sums of squares finite."""
_QUANTITY = re.compile(r"([-+]?[\d.]+(?:[eE][-+]?\d+)?)(?![\d.])\s*([^\s:_].*)")
_OTHER_BASE = re.compile(r"[-+]?0[box][\da-f]+", re.IGNORECASE)
_NUMBER = re.compile(
    r"[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?|[-+]?(?:inf|infinity|nan)", re.ASCII | re.IGNORECASE
)
_POWER = re.compile(r"(?<=[^\W\d_])(-?\d)")  # of mm2, min-1
_INSTEAD = (  # a common wrong unit, the expected unit, and advice
    ("1/s", "rad/s", "write rpm or rev/s for turns"),
    ("C", "K", "write degC"),
    ("F", "K", "write degF"),
    ("m^2/s", "Pa s", "dynamic viscosity = kinematic viscosity x density"),
    ("kg m^2", "kg", "it is J/r^2 of a moment of inertia J"),
)
_SPELLINGS = {  # without separators, in small letters, and what they mean if they fit the quantity
    "rpm": "rpm", "r/min": "rpm", "u/min": "rpm", "tr/min": "rpm", "rps": "rev/s",
    "r/s": "rev/s", "u/s": "rev/s", "dps": "deg/s", "degc": "degC", "degf": "degF", "ºc": "degC",
    "celsius": "degC", "℃": "degC", "℉": "degF", "g": "g_n", "y": "year",
    "ftlb": "ft lbf", "ftlbs": "ft lbf", "ftlbf": "ft lbf", "lbft": "ft lbf", "lbfft": "ft lbf",
    "inlb": "in lbf", "inlbs": "in lbf", "inlbf": "in lbf", "lbin": "in lbf", "lbfin": "in lbf",
    "ozin": "in ozf", "ozfin": "in ozf", "inoz": "in ozf", "inozf": "in ozf",
    "kgfm": "kgf m", "kgfcm": "kgf cm", "kgcm": "kgf cm", "nm": "N m", "ncm": "N cm", "nmm": "N mm",
}  # fmt: skip
_SEPARATORS = re.compile(r"[\s*·⋅.-]")
_HYPHEN = re.compile(r"(?<=[^\W\d_])-(?=[^\W\d_])")  # of N-m
_MASS = re.compile(r"\b(lb|oz|kg)s?\b")  # whose weight is a force

_CUSTOMARY = {  # by SI unit: customary unit, factor, and offset
    "rad/s": ("rpm", 30.0 / math.pi, 0.0),
    "rad": ("deg", 180.0 / math.pi, 0.0),
    "K": ("degC", 1.0, 273.15),
    "Pa": ("MPa", 1e-6, 0.0),
}

_COMMON = {  # factor and offset of units that most scenes use: loading pint takes half a second
    ("mm", "m"): (1e-3, 0.0),
    ("um", "m"): (1e-6, 0.0),
    ("g", "kg"): (1e-3, 0.0),
    ("ms", "s"): (1e-3, 0.0),
    ("kHz", "Hz"): (1e3, 0.0),
    ("kW", "W"): (1e3, 0.0),
    ("kN m", "N m"): (1e3, 0.0),
    ("MPa", "Pa"): (1e6, 0.0),
    ("GPa", "Pa"): (1e9, 0.0),
    ("rpm", "rad/s"): (math.pi / 30.0, 0.0),
    ("deg", "rad"): (math.pi / 180.0, 0.0),
    ("degC", "K"): (1.0, 273.15),
}

# pint evaluates a unit as an expression, so it would compute every digit of 10**10**10.
_LONGEST_UNIT = 60  # characters
_MANY_DIGITS = re.compile(r"\d{4}|[⁰¹²³⁴-⁹]{3}")
_POWERS = re.compile(r"\*\*|\^")
_RAISED = re.compile(r"[^\W\d]\s*(?:\*\*|\^)\s*\(?[-+]?\d{1,2}(?![\d\s]*[\d*^])")  # power of a name


class UnitError(ValueError):
    """A number in a wrong unit, or with a decimal comma."""


def rpm(value: float) -> float:
    """Convert a speed from revolutions per minute to rad/s.

    Args:
        value: speed [rpm].

    Returns:
        Speed [rad/s].
    """
    return value * math.pi / 30.0


@cache
def _registry() -> Any:
    import pint

    registry: Any = pint.UnitRegistry(
        autoconvert_offset_to_baseunit=True,
        preprocessors=[lambda text: _POWER.sub(r"**\1", text)],
    )
    registry.define("newton_metre = newton * metre = Nm")  # otherwise nanometres
    registry.define("pascal_second = pascal * second = Pas")
    registry.define("@alias turn = rev")
    return registry


def to_si(value: object, unit: str) -> object:
    """Convert a text such as ``"0.2 um"`` to a number.

    Args:
        value: text with or without a unit; other values are returned unchanged.
        unit: SI unit of the result.

    Returns:
        Number in `unit`.

    Raises:
        UnitError: the text has a comma, or its unit does not match `unit`.
        ValueError: the text is not a number with a unit, or the value is true or false.
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
    # Number and unit are parsed separately, because pint drops unknown characters in expressions.
    if parts is None or not is_number(parts[1]) or _OTHER_BASE.fullmatch(value.strip()):
        raise ValueError(f"{value!r} is not a number with a unit")
    return float(column_to_si(np.array(float(parts[1])), parts[2], unit))


def customary(value: float, unit: str, digits: int = 4) -> str:
    """Format a quantity in its customary unit: 1000 rad/s is "9549 rpm".

    Args:
        value: in SI.
        unit: SI unit of `value`.
        digits: significant digits.

    Returns:
        Number and unit; empty if there is no customary unit.
    """
    if unit == "m":
        name, factor = ("um", 1e6) if abs(value) < 1e-4 else ("mm", 1e3)
        return f"{factor * value:.{digits}g} {name}"
    name, factor, zero = _CUSTOMARY.get(unit, ("", 1.0, 0.0))
    return f"{factor * value - zero:.{digits}g} {name}" if name else ""


def is_number(text: str) -> bool:
    """Whether a text is a decimal number without a unit.

    Underscores and digits of other scripts, which `float` of Python accepts, are not.

    Args:
        text: any text.
    """
    return _NUMBER.fullmatch(text.strip()) is not None


def has_unit(text: str) -> bool:
    """Whether a text is a number with a unit.

    Args:
        text: any text.
    """
    return not is_number(text) and _QUANTITY.fullmatch(text.strip()) is not None


def column_to_si(values: NDArray[np.float64], given: str, unit: str) -> NDArray[np.float64]:
    """Convert values to SI.

    Args:
        values: any shape.
        given: unit of `values`, e.g. "rpm"; "-" for dimensionless numbers.
        unit: SI unit of the result.

    Returns:
        Values in `unit`, same shape.

    Raises:
        UnitError: `given` does not match `unit`.
    """
    if given == unit or (given, unit) in _COMMON:
        factor, offset = _COMMON.get((given, unit), (1.0, 0.0))
        return factor * values + offset
    name = next((name for name in _spelled(given) if _compatible(name, unit)), None)
    if name is None:
        raise UnitError(f"[{given}] cannot be converted to {unit or '1'}{_instead(given, unit)}")
    source, target = _unit(name), _unit(unit)
    return np.asarray(_registry().Quantity(values, source).to(target).magnitude, dtype=float)


def _spelled(given: str) -> Iterator[str]:
    """Units that the text `given` may stand for, the likely one first."""
    yield given
    product = _HYPHEN.sub("*", given)
    yield product
    yield _SPELLINGS.get(_SEPARATORS.sub("", given).casefold(), given)
    yield _MASS.sub(r"\1f", product)


def _instead(given: str, unit: str) -> str:
    """Advice for the wrong unit `given`, to append to an error message; may be empty."""
    common = [name for name, target in _COMMON if target == unit]
    for name in common:
        if name.casefold() == given.casefold():
            return f"; write {name}"
    for source, target, advice in _INSTEAD:
        if _compatible(given, source) and _compatible(unit, target):
            return f"; {advice}"
    return f"; write, for example, {' or '.join([unit, *common])}" if unit else ""


def _unit(name: str) -> Any:
    powers = len(_RAISED.findall(name))
    if (
        len(name) > _LONGEST_UNIT
        or _MANY_DIGITS.search(name)
        or len(_POWERS.findall(name)) > powers
    ):
        raise UnitError("must be units with powers of one or two digits")
    return _registry().Unit("" if name == "-" else name)


def _compatible(one: str, other: str) -> bool:
    """Whether two texts are units of the same quantity.

    Angles count as a dimension: "1/min" is not a unit of rad/s, because a turn is not a radian.
    """
    registry = _registry()
    try:
        roots = [registry.get_root_units(_unit(name))[1] for name in (one, other)]
    except Exception:  # of many kinds, if the text is not a unit
        return False
    return bool(roots[0] == roots[1])
