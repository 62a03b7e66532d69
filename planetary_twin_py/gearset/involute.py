"""Outlines of involute spur gears, external and internal.

The flanks are true involutes of the base circle r_b = r cos(alpha); the tooth fills half the
pitch on the pitch circle (no profile shift, no backlash). Addendum 1.0 m, dedendum 1.25 m. The
root is simplified: where the root circle lies inside the base circle, a radial line joins the
involute's start to the root circle in place of the trochoid that a hob would cut.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

ADDENDUM = 1.0  # of the module
DEDENDUM = 1.25  # of the module


def involute(pressure_angle: NDArray[np.float64] | float) -> NDArray[np.float64]:
    """Involute function tan(a) - a [rad] of the pressure angle [rad]."""
    return np.tan(pressure_angle) - pressure_angle


def tip_radius(teeth: int, module: float, internal: bool = False) -> float:
    """Radius of the tip circle [m]; an internal gear's teeth point inwards."""
    return module * (0.5 * teeth + (-ADDENDUM if internal else ADDENDUM))


def root_radius(teeth: int, module: float, internal: bool = False) -> float:
    """Radius of the root circle [m]."""
    return module * (0.5 * teeth + (DEDENDUM if internal else -DEDENDUM))


def half_thickness(
    radius: NDArray[np.float64] | float,
    teeth: int,
    module: float,
    pressure_angle: float,
    internal: bool = False,
) -> NDArray[np.float64]:
    """Half the angle [rad] that a tooth spans on the circle of `radius` [m].

    Inside the base circle there is no involute: the flank runs on radially.
    """
    base = 0.5 * module * teeth * math.cos(pressure_angle)
    local = np.arccos(np.minimum(base / np.asarray(radius, dtype=float), 1.0))
    thinning = involute(local) - involute(pressure_angle)
    return 0.5 * math.pi / teeth + (thinning if internal else -thinning)


def tooth_outline(
    teeth: int, module: float, pressure_angle: float, internal: bool = False, points: int = 9
) -> NDArray[np.float64]:
    """One tooth and the root land after it, as polar points (radius [m], angle [rad]).

    The tooth is centred on angle zero; the points run counter-clockwise, shape (k, 2). `points`
    counts those on each flank.
    """
    tip = tip_radius(teeth, module, internal)
    root = root_radius(teeth, module, internal)
    if internal and tip < 0.5 * module * teeth * math.cos(pressure_angle):
        raise ValueError(
            f"ring teeth = {teeth}: tips lie inside the base circle at a pressure angle of "
            f"{math.degrees(pressure_angle):.2f} deg; more teeth or a larger angle are needed"
        )
    start = max(root, 0.5 * module * teeth * math.cos(pressure_angle))
    radii = np.linspace(start, tip, points) if not internal else np.linspace(root, tip, points)
    if root < start:
        radii = np.concatenate(([root], radii))
    half = half_thickness(radii, teeth, module, pressure_angle, internal)
    if half[-1] <= 0.0:
        raise ValueError(f"teeth = {teeth}: the tooth is pointed below its tip circle")
    rising = np.column_stack((radii, -half))
    tip_land = np.column_stack((np.full(3, tip), half[-1] * np.array([-0.5, 0.0, 0.5])))
    falling = np.column_stack((radii, half))[::-1]
    gap = 2.0 * math.pi / teeth - 2.0 * half[0]
    root_land = np.column_stack((np.full(3, root), half[0] + gap * np.array([0.25, 0.5, 0.75])))
    return np.concatenate((rising, tip_land, falling, root_land))


def gear_outline(
    teeth: int, module: float, pressure_angle: float, internal: bool = False, points: int = 9
) -> NDArray[np.float64]:
    """Closed outline of a whole gear, as polar points (radius [m], angle [rad]).

    Tooth 0 is centred on angle zero; the points run counter-clockwise once around, shape (n, 2).
    """
    tooth = tooth_outline(teeth, module, pressure_angle, internal, points)
    turns = 2.0 * math.pi / teeth * np.arange(teeth)
    outline = np.tile(tooth, (teeth, 1))
    outline[:, 1] += np.repeat(turns, len(tooth))
    return outline
