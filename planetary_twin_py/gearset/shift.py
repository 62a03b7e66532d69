"""Profile shift: tooth thickness, working pressure angle, and distance without backlash.

Signs are those of ISO 21771: a positive shift makes the tooth of any gear thicker on its reference
circle. It moves the teeth of an external gear outwards and those of an internal gear inwards. Some
books count the shift of internal gears the other way round (Colbourne 1987, ch. 8; AGMA).
"""

from __future__ import annotations

import math
from typing import NamedTuple

_ITERATIONS = 60


class PerGear(NamedTuple):
    """A value for sun, planet and ring."""

    sun: float
    planet: float
    ring: float


def involute(angle: float) -> float:
    """Involute function tan(a) - a [rad] (ISO 21771:2007, eq. 4).

    Args:
        angle: a [rad].
    """
    return math.tan(angle) - angle


def inverse_involute(value: float) -> float:
    """Angle [rad] with the given involute function, by Newton's method from above.

    The involute function is convex, so the iteration is monotone: d inv a/da = tan^2 a.

    Args:
        value: of the involute function [rad], at least 0.
    """
    angle = math.atan((3.0 * value) ** (1.0 / 3.0)) if value < 0.1 else math.atan(value + 1.57)
    for _ in range(_ITERATIONS):
        step = (involute(angle) - value) / max(math.tan(angle) ** 2, 1e-300)
        angle -= step
        if abs(step) <= 1e-16:
            break
    return angle


def backlash_free_angle(teeth: int, shift: float, pressure_angle: float) -> float | None:
    """Working pressure angle of a mesh without backlash (ISO 21771:2007, eq. 62).

    inv a_w = inv a + 2 tan(a) (x1 + x2)/(z1 + z2), with z negative for an internal gear.

    Args:
        teeth: z1 + z2 of an external mesh; z1 - z2, which is negative, of an internal mesh.
        shift: x1 + x2 [modules].
        pressure_angle: a [rad].

    Returns:
        The angle [rad], None if the teeth are too thin or too thick at any distance.
    """
    if shift == 0.0:
        return pressure_angle
    value = involute(pressure_angle) + 2.0 * math.tan(pressure_angle) * shift / teeth
    return inverse_involute(value) if value > 0.0 else None


def working_angle(reference: float, distance: float, pressure_angle: float) -> float | None:
    """Working pressure angle, cos a_w = a cos(alpha)/a_w (ISO 21771:2007, eq. 60).

    Args:
        reference: centre distance at which the reference circles touch [m].
        distance: centre distance [m].
        pressure_angle: on the reference circles [rad].

    Returns:
        The angle [rad], None if the base circles would have no common tangent.
    """
    if distance == reference:
        return pressure_angle  # to the last bit
    cosine = reference * math.cos(pressure_angle) / distance
    return math.acos(cosine) if 0.0 < cosine < 1.0 else None
