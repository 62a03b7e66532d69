"""A loss absent from the model that would explain the residuals."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from ...scene import Scene
from .least_squares import Array, Minimum, bounds_of
from .parameter import Parameter

SHARE = 1e-2  # of the input torque: a trial drag small enough for a linear effect
PART = 0.5  # fraction of the sum of squares that a loss must explain
NOISE = 11.0  # decrease of the sum of squares due to noise with probability 1e-3: chi^2_1

Trial = Callable[[str, float], Array | None]
"""Residuals (m,) at a minimum with a further field at a value; None if the simulation fails."""


class MissingLoss(NamedTuple):
    """A field that is zero in the model, and its linear estimate."""

    field: str
    value: float
    """Estimate in SI."""
    unit: str
    sum: float
    """Expected sum of squares with this value."""


def find_missing_loss(
    scene: Scene, parameters: Sequence[Parameter], minimum: Minimum, trial: Trial
) -> MissingLoss | None:
    """Find the load-independent drag of the input shaft that reduces the sum of squares most.

    Score test of an omitted parameter (Rao 1948, Proc. Cambridge Phil. Soc. 44, 50-57) with ranges:
    the model linearised at the minimum is solved with the omitted parameter as a further
    non-negative unknown. It is None if no field would at least halve the sum of squares and reduce
    it by more than noise does.
    """
    from scipy.optimize import lsq_linear

    low, high = bounds_of(parameters)
    size = np.array([p.scale for p in parameters])
    losses = []
    for field, unit, drag in _candidates(scene):
        trial_residuals = None if any(p.name == field for p in parameters) else trial(field, drag)
        if trial_residuals is None:
            continue
        slopes = np.column_stack([minimum.slopes * size, trial_residuals - minimum.residuals])
        ends = np.append((low - minimum.values) / size, 0.0), (high - minimum.values) / size
        solution = lsq_linear(slopes, -minimum.residuals, (ends[0], np.append(ends[1], np.inf)))
        remaining = 2.0 * float(solution.cost)
        if minimum.sum - remaining > max(PART * minimum.sum, NOISE):
            losses.append(MissingLoss(field, float(solution.x[-1]) * drag, unit, remaining))
    return min(losses, key=lambda candidate: candidate.sum, default=None)


def _candidates(scene: Scene) -> Iterator[tuple[str, str, float]]:
    """Drags that are zero in the scene: name, unit, and a small trial value."""
    member, point = scene.drive.input.member, scene.operating_point
    drag = getattr(scene.losses, f"{member}_drag")
    torque = SHARE * (abs(point.input_torque) or scene.drive.torque_limit)
    if drag.coulomb == 0.0:
        yield f"losses.{member}_drag.coulomb", "N m", torque
    if drag.viscous == 0.0:
        speed = abs(point.input_speed) or scene.drive.speed_limit
        yield f"losses.{member}_drag.viscous", "N m s/rad", torque / speed
