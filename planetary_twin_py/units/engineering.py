"""Figures for a reader in units of engineering practice: 932.3 kN, 936 MPa, 20 deg."""

from __future__ import annotations

import math

_KILO_FROM = 1e4
"""Magnitude from which a force, a torque or a power is printed in kilo."""
_KILO = ("N", "N m", "W")

_ROUNDING = 1e-11
"""Relative error of sums of forces and displacements in 64-bit numbers."""


def without_rounding(value: float, scale: float) -> float:
    """The value, or 0 if it can be a rounding error of a sum.

    Args:
        value: in any unit.
        scale: size of the terms of the sum, in the same unit.
    """
    return value if abs(value) > _ROUNDING * scale else 0.0


def figure(value: float, unit: str, digits: int = 4) -> str:
    """Format a quantity in the unit that engineers use for its size.

    Args:
        value: in SI.
        unit: SI unit of `value`; "" or "-" for a number without a unit.
        digits: significant digits.

    Returns:
        Number and unit, e.g. "-616.3 um"; the number alone if it has no unit, or "-" for NaN.
    """
    from .conversion import customary  # imports NumPy, which completion does not need

    if math.isnan(value):
        return "-"
    if unit in ("", "-"):
        return f"{value:.{digits}g}"
    if unit in _KILO and abs(value) >= _KILO_FROM:
        return f"{1e-3 * value:.{digits}g} k{unit}"
    if unit == "N/m":
        return f"{1e-6 * value:.{digits}g} N/um"
    return customary(value, unit, digits) or f"{value:.{digits}g} {unit}"


def percent(share: float, digits: int = 2) -> str:
    """Format a share in per cent, large ones without a power of ten.

    Args:
        share: the share, 1 for the whole.
        digits: significant digits.

    Returns:
        Number and sign, e.g. "820 %".
    """
    return f"{float(f'{100.0 * share:.{digits}g}'):.12g} %"
