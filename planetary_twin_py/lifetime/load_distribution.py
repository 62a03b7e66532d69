"""How long, and for how many turns, a duty has each torque; torque of constant duty."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .duty_table import STD, Duty

Array = NDArray[np.float64]

LEVELS = 50


class LoadDistribution(NamedTuple):
    """Load duration distribution (LDD) and load revolution distribution (LRD) of a duty."""

    edges: Array
    """Edges of the levels of input torque [N m], ascending, (levels + 1,)."""
    duration: Array
    """Time in each level [s], (levels,)."""
    turns: Array
    """Turns of the input in each level, in either direction, (levels,)."""


def load_distribution(duty: Duty, levels: int = LEVELS) -> LoadDistribution:
    """Time and turns of a duty in levels of torque of equal width.

    Torque that scatters within a row with a standard deviation is taken as normal.

    Args:
        duty: the duty.
        levels: number of levels.

    Returns:
        Both distributions; the sums are those of the duty.
    """
    torque = duty.columns["input_torque"]
    spread = duty.columns.get(STD, np.zeros(len(torque)))
    low, high = float((torque - 3.0 * spread).min()), float((torque + 3.0 * spread).max())
    if not high > low:
        low, high = low - 0.5 * (abs(low) or 1.0) / levels, high + 0.5 * (abs(high) or 1.0) / levels
    edges = np.linspace(low, high, levels + 1)
    steady = spread == 0.0
    turns = np.abs(duty.columns["input_speed"]) * duty.held / (2.0 * math.pi)
    sums = []
    for amount in (duty.held, turns):
        found = np.histogram(torque[steady], edges, weights=amount[steady])[0]
        if not steady.all():
            found = found + _spread_out(edges, torque[~steady], spread[~steady], amount[~steady])
        sums.append(np.asarray(found, dtype=np.float64))
    return LoadDistribution(edges, *sums)


def _spread_out(edges: Array, mean: Array, deviation: Array, amount: Array) -> Array:
    from scipy.special import ndtr

    inner, found = edges[1:-1], np.zeros(len(edges) - 1)
    below = np.zeros(len(mean))
    for level in range(len(found)):
        here = ndtr((inner[level] - mean) / deviation) if level < len(inner) else np.ones(len(mean))
        found[level] = math.fsum((here - below) * amount)
        below = here
    return found


def equivalent_torque(torque: Array, turns: Array, exponent: float, cycles: float) -> float:
    """Constant torque that does the same damage.

    Args:
        torque: [N m], of either sign, (n,).
        turns: of the input under each, (n,).
        exponent: m: damage of a turn is proportional to |torque|^m, above 0.
        cycles: n_eq, turns under the constant torque, above 0.

    Returns:
        (sum n_i |T_i|^m / n_eq)^(1/m) [N m].
    """
    largest = float(np.abs(torque).max(initial=0.0))  # powers of the torques might overflow
    if largest == 0.0:
        return 0.0
    total = math.fsum(turns * (np.abs(torque) / largest) ** exponent)
    return float(largest * (total / cycles) ** (1.0 / exponent))
