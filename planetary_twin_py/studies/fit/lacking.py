"""Which loss that the model leaves out would explain what it misses."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from ...scene import Scene
from .least_squares import Array, Minimum, bounds_of
from .parameter import Parameter

SHARE = 1e-2  # of the input torque: a trial drag, within which its effect is linear
PART = 0.5  # of the sum of squares, below which a loss does not explain it
NOISE = 11.0  # fall of the sum of squares that noise brings with a chance of 1e-3: chi^2_1

Trial = Callable[[str, float], Array | None]
"""Residuals (m,) at a minimum with a further field at a value; None where there are none."""


class Lacking(NamedTuple):
    """A field that is zero in the model, and what freeing it is expected to give."""

    field: str
    value: float
    """Estimate of it, in SI."""
    unit: str
    sum: float
    """Of squares that would be left."""


def find_lacking(
    scene: Scene, parameters: Sequence[Parameter], minimum: Minimum, trial: Trial
) -> Lacking | None:
    """The load-independent drag of the input shaft that would lower the sum of squares most.

    The score test of an omitted parameter (Rao 1948, Proc. Cambridge Phil. Soc. 44, 50-57), with
    ranges: the linear model at the minimum is solved again with the omitted one as a further
    unknown that is not negative.

    Args:
        scene: the model.
        parameters: what is free.
        minimum: where the sum of squares is least.
        trial: see `Trial`.

    Returns:
        The field, or None if none is expected to lower the sum of squares by more than half of it,
        and by more than noise may.
    """
    from scipy.optimize import lsq_linear

    low, high = bounds_of(parameters)
    size = np.array([p.scale for p in parameters])
    found = []
    for field, unit, drag in _candidates(scene):
        there = None if any(p.name == field for p in parameters) else trial(field, drag)
        if there is None:
            continue
        slopes = np.column_stack([minimum.slopes * size, there - minimum.residuals])
        ends = np.append((low - minimum.values) / size, 0.0), (high - minimum.values) / size
        done = lsq_linear(slopes, -minimum.residuals, (ends[0], np.append(ends[1], np.inf)))
        left = 2.0 * float(done.cost)
        if minimum.sum - left > max(PART * minimum.sum, NOISE):
            found.append(Lacking(field, float(done.x[-1]) * drag, unit, left))
    return min(found, key=lambda candidate: candidate.sum, default=None)


def _candidates(scene: Scene) -> Iterator[tuple[str, str, float]]:
    """Drags that the scene leaves out: name, unit, and a value that is small for it."""
    member, point = scene.drive.input.member, scene.operating_point
    drag = getattr(scene.losses, f"{member}_drag")
    torque = SHARE * (abs(point.input_torque) or scene.drive.torque_limit)
    if drag.coulomb == 0.0:
        yield f"losses.{member}_drag.coulomb", "N m", torque
    if drag.viscous == 0.0:
        speed = abs(point.input_speed) or scene.drive.speed_limit
        yield f"losses.{member}_drag.viscous", "N m s/rad", torque / speed
