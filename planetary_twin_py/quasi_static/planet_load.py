"""How planets share the load: each is a spring with play between sun and ring.

The transmission errors of a planet's two meshes add up to w = x_s + x_r - 2 x_c, whatever the
planet does, so one wind-up w squeezes all planets. The force F on the ring and F + R on the sun
(R: what rubs on the planet) follow from w by pieces of straight lines.
"""

from __future__ import annotations

import math

import numpy as np

from .._compile import kernel, law
from .._records import MESHES, REAL, Record, layout

MOST_TRIALS = 200
CLOSED = 1e-14  # of the forces, to which they add up

# Every planet as a spring.
SPRINGS = layout(
    copies=(REAL, (MESHES,)),  # planets that move alike, of which it is one
    error=(REAL, (MESHES,)),  # errors of form, and what `rub` squeezes the sun mesh by [m]
    compliance=(REAL, (MESHES,)),  # of both meshes in series [m/N]
    rub=(REAL, (MESHES,)),  # what rubs on the planet [N]
    steps=(REAL, (MESHES, 3)),  # see `ring_force` [m]
)


@law
def ring_force(
    w: float, compliance: float, rub: float, steps: tuple[float, float, float]
) -> tuple[float, float]:
    """Force [N] of a planet on the ring and its growth with w [N/m].

    Args:
        w: wind-up less errors of form and less what `rub` squeezes the sun mesh by [m].
        compliance: of both meshes in series [m/N].
        rub: what rubs on the planet [N].
        steps: play passed with both meshes on the coast side, with one on each, and with both on
            the drive side [m].
    """
    first, last = min(0.0, -rub), max(0.0, -rub)  # where one of the meshes is free of load
    growth = 1.0 / compliance
    force = (w - steps[2]) * growth
    if force > last:
        return force, growth
    force = (w - steps[1]) * growth
    if force > last:
        return last, 0.0
    if force > first:
        return force, growth
    force = (w - steps[0]) * growth
    if force < first:
        return force, growth
    return first, 0.0


@law
def wind_up_at(
    force: float, compliance: float, rub: float, steps: tuple[float, float, float]
) -> float:
    """A w at which the planet has `force` on the ring [m]: the inverse of `ring_force`."""
    first, last = min(0.0, -rub), max(0.0, -rub)
    if force > last:
        step = steps[2]
    elif force < first:
        step = steps[0]
    elif first < force < last:
        step = steps[1]
    elif first == last:
        step = 0.5 * (steps[0] + steps[2])
    else:
        step = 0.5 * (steps[1] + (steps[2] if force == last else steps[0]))
    return compliance * force + step


@law
def _steps(springs: Record, p: int) -> tuple[float, float, float]:
    return springs.steps[p, 0], springs.steps[p, 1], springs.steps[p, 2]


@kernel
def planet_force(springs: Record, p: int, w: float) -> tuple[float, float]:
    """Force [N] of planet p on the ring at the wind-up w [m], and its growth with w."""
    return ring_force(
        w - springs.error[p], springs.compliance[p], springs.rub[p], _steps(springs, p)
    )


@kernel
def share(total: float, planets: int, springs: Record) -> float:
    """The wind-up w [m] at which the planets with their copies have `total` [N] on the ring.

    Newton's method on a sum of rising lines, within a bracket.
    """
    low, high, stiffness, w = math.inf, -math.inf, 0.0, 0.0
    mean = total / np.sum(springs.copies[:planets])
    for p in range(planets):
        compliance = springs.compliance[p]
        alone = wind_up_at(mean, compliance, springs.rub[p], _steps(springs, p))
        alone += springs.error[p]
        low, high = min(low, alone), max(high, alone)
        w += springs.copies[p] * alone / compliance
        stiffness += springs.copies[p] / compliance
    w = min(max(w / stiffness, low), high)
    for _ in range(MOST_TRIALS):
        force, growth, size = 0.0, 0.0, abs(total)
        for p in range(planets):
            one, slope = planet_force(springs, p, w)
            force += springs.copies[p] * one
            growth += springs.copies[p] * slope
            size += springs.copies[p] * abs(one)
        if abs(force - total) <= CLOSED * size:
            break
        if force < total:
            low = w
        else:
            high = w
        w = w + (total - force) / growth if growth > 0.0 else math.inf
        if not low < w < high:
            w = 0.5 * (low + high)
            if not low < w < high:  # neighbouring numbers
                break
    return w
