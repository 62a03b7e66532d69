"""Root fillets, which connect the involute flank to the root circle.

A fillet is a curve from the root circle (t = 0) to the flank (t = 1), given as radius [m] and half
angle [rad] of the tooth. The fillet of an external tooth is the trochoid that the basic rack cuts;
with undercut it ends at the intersection with the remaining involute. The fillet of an internal
tooth is the circular arc tangent to the flank and the root circle.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ..gearset.involute import SpurGear

Floats = NDArray[np.float64]
Fillet = Callable[[Floats], tuple[Floats, Floats]]


def fillet(gear: SpurGear) -> Fillet:
    """Fillet of a gear.

    Args:
        gear: the gear.

    Returns:
        Function of t in [0, 1], any shape, that returns radius [m] and half angle [rad].

    Raises:
        ValueError: the pressure angle leaves no space between the teeth at the root circle.
    """
    return _arc(gear) if gear.internal else _trochoid(gear)


def _trochoid(gear: SpurGear) -> Fillet:
    """Envelope of the rounded tip of a rack tooth that rolls on the pitch circle.

    A point of the tip with its normal at the angle psi to the pitch line cuts when this normal
    passes through the pitch point; psi decreases from 90 deg at the root circle to the pressure
    angle. A profile shift draws the rack out of the gear by x modules, so its pitch line is not its
    datum line (Salamoun and Suchy 1973).
    """
    pitch, alpha = gear.pitch_radius, gear.pressure_angle
    depth = gear.dedendum * gear.module
    rounding = _rounding(gear)
    centre = depth - rounding
    offset = 0.25 * math.pi * gear.module - centre * math.tan(alpha) - rounding / math.cos(alpha)
    centre -= gear.profile_shift * gear.module  # from the rack's datum line to its pitch line

    def cut(psi: Floats) -> tuple[Floats, Floats]:
        across = centre / np.tan(psi) + rounding * np.cos(psi)
        along = pitch - centre - rounding * np.sin(psi)
        rolled = (centre / np.tan(psi) - offset) / pitch
        half = math.pi / gear.teeth - (np.arctan2(across, along) - rolled)
        return np.hypot(across, along), half

    last = _undercut(gear, cut) if _undercuts(gear) else alpha
    return lambda t: cut(0.5 * math.pi + (last - 0.5 * math.pi) * t)


def straight_reach(gear: SpurGear) -> float:
    """Depth of the end of the rack's straight flank below the pitch line [m].

    Args:
        gear: the external gear that the rack cuts.
    """
    depth, alpha = gear.dedendum * gear.module, gear.pressure_angle
    rounding = _rounding(gear)
    return depth - rounding * (1.0 - math.sin(alpha)) - gear.profile_shift * gear.module


def _rounding(gear: SpurGear) -> float:
    """Tip radius of the rack [m]: that of the basic rack, or one arc for both corners."""
    largest = largest_rounding(gear.dedendum, gear.pressure_angle)
    return min(gear.fillet, largest) * gear.module


def largest_rounding(dedendum: float, pressure_angle: float) -> float:
    """Tip radius with which one arc rounds both corners of a rack tooth [modules].

    Args:
        dedendum: height of the rack tooth [modules].
        pressure_angle: [rad].

    Raises:
        ValueError: the pressure angle leaves no space for a tip.
    """
    room = 0.25 * math.pi - dedendum * math.tan(pressure_angle)
    if room <= 0.0:
        largest = math.degrees(math.atan(0.25 * math.pi / dedendum))
        raise ValueError(
            f"pressure_angle = {math.degrees(pressure_angle):g} deg: the rack tooth that cuts the "
            f"gear is pointed above its tip; must be below {largest:.4g} deg"
        )
    return room * math.cos(pressure_angle) / (1.0 - math.sin(pressure_angle))


def _undercuts(gear: SpurGear) -> bool:
    """Whether the straight flank of the rack extends beyond the start of the involute."""
    return straight_reach(gear) > gear.pitch_radius * math.sin(gear.pressure_angle) ** 2


def _undercut(gear: SpurGear, cut: Fillet) -> float:
    """Angle psi at which the trochoid meets the involute outside the base circle."""

    def excess(psi: float) -> float:
        radius, half = cut(np.array(psi))
        return float(half - gear.half_thickness(radius))

    grid = np.linspace(0.5 * math.pi, gear.pressure_angle, 400)
    radius, half = cut(grid)
    within = np.flatnonzero(half < gear.half_thickness(radius))
    if not len(within):  # undercut below the resolution of the grid
        return gear.pressure_angle
    return _root(excess, grid[within[-1]], grid[within[-1] + 1])


def _arc(gear: SpurGear) -> Fillet:
    """Circle tangent to the involute flank and the root circle of an internal gear.

    Its centre is on the tangent of the base circle through its contact point with the flank, at the
    distance `rounding` before this point.
    """
    base, root = gear.base_radius, gear.root_radius

    def touch(rounding: float) -> tuple[float, float, float]:
        """Tangent length to the flank [m]; directions of centre and flank normal [rad]."""
        string = rounding + math.sqrt((root - rounding) ** 2 - base**2)
        tooth = float(gear.half_thickness(np.array(math.hypot(base, string))))
        foot = math.pi / gear.teeth - tooth - math.atan2(string, base)
        return string, foot + math.atan2(string - rounding, base), foot + 0.5 * math.pi

    if touch(0.0)[1] <= 0.0:
        raise ValueError(
            f"pressure_angle = {math.degrees(gear.pressure_angle):g} deg: the flanks of a gear "
            f"with {gear.teeth} internal teeth meet before its root circle"
        )
    rounding = gear.fillet * gear.module
    if touch(rounding)[1] < 0.0:  # the two arcs of a gap would overlap: use one arc
        rounding = _root(lambda r: touch(r)[1], 0.0, rounding)
    _, middle, normal = touch(rounding)

    def point(t: Floats) -> tuple[Floats, Floats]:
        towards = middle + (normal - middle) * t
        at = (root - rounding) * np.exp(1j * middle) + rounding * np.exp(1j * towards)
        return np.abs(at), math.pi / gear.teeth - np.angle(at)

    return point


def _root(function: Callable[[float], float], low: float, high: float) -> float:
    """Root of `function` between `low` and `high`."""
    from scipy.optimize import brentq  # takes half a second to load, and few gears need it

    return float(brentq(function, low, high))
