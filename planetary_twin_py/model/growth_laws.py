"""Growth of a fault with the passages of its tooth, by the laws of a scene."""

from __future__ import annotations

import math

import numpy as np

from ..lubrication.wear import depth_of_passage
from ..scene.growth import Archard, Paris, Table

PASCAL = 1e-6  # [MPa]


def table_severity(growth: Table, place: float) -> float:
    """Severity at a time [s], or after so many passages: linear between the points of a table."""
    return float(np.interp(place, growth.places, growth.severities))


def paris_depth(growth: Paris, depth: float, cycles: float, load: float = 1.0) -> float:
    """Depth of a crack after cycles of constant stress, in closed form.

    da/dN = C (Y ds sqrt(pi a))^m (Paris and Erdogan 1963, (4)): a^(1 - m/2) is linear in N, or
    log(a) if m = 2.

    Args:
        growth: the law.
        depth: at the start [m].
        cycles: number of cycles.
        load: factor on the stress range.

    Returns:
        The depth, at most `until` [m].
    """
    if depth == 0.0:
        return 0.0
    intensity = growth.geometry * PASCAL * growth.stress_range * load * math.sqrt(math.pi)
    rate, power = growth.constant * intensity**growth.exponent, 1.0 - 0.5 * growth.exponent
    if power == 0.0:
        gained = rate * cycles
        return growth.until if gained > math.log(growth.until / depth) else depth * math.exp(gained)
    reached = depth**power + power * rate * cycles
    if power < 0.0 and reached <= growth.until**power:
        return growth.until
    return min(reached ** (1.0 / power), growth.until)


def archard_depth(growth: Archard, depth: float, passages: float, load: float = 1.0) -> float:
    """Depth of wear after passages: coefficient x pressure x sliding way in each (Archard 1953).

    Args:
        growth: the law.
        depth: at the start [m].
        passages: number of passages.
        load: factor on the force, in proportion to which pressure x half width grows.

    Returns:
        The depth, at most `until` [m].
    """
    line_load = 2.0 * growth.half_width * growth.pressure * load
    each = depth_of_passage(growth.coefficient, line_load, growth.slip)
    return min(depth + each * passages, growth.until)
